"""Leaves out readings that are codes, that no machine reaches, or of doubled or missing pulses.

Both are facts about the channel, and never events of the gearbox. The readings of a follower are
those of one gearbox, the rows of a fleet those of many.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from .channels.all import MOVING, SENSORS, TORQUES
from .channels.sensor import Sensor
from .checks import CHECKED, InputError
from .codes import Codes
from .left_out import LeftOut
from .pulses import Pulses
from .repeats import STUCK, Repeats
from .sensors import Sensors, torque_change
from .train import FollowedTrain

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

CODE = "the value is a code for a missing or saturated reading"
STOPS = "it leaps to 0 and back between two readings, as no shaft with inertia does"


class _Limits:
    """Counts the readings of a channel beyond the limits of the scene, of each gearbox."""

    def __init__(self, sensor: Sensor, train: FollowedTrain, count: int) -> None:
        self.sensor, self.allowed = sensor, sensor.limits(train)
        self._least = sensor.shown * sensor.nominal(train)
        self._count = count
        self.begin = np.full(count, math.nan)  # [s] first reading that shows the quantity
        self.restart()

    def restart(self) -> None:
        """Forget what was counted."""
        self._shown, self._beyond, self._sum = np.zeros((3, self._count))

    def judge(self, time: Array, values: Array, within: float) -> tuple[Mask, bool]:
        """Which readings are beyond the limits, and whether the time in which they count is over.

        Args:
            time: stamps [s], (n,).
            values: readings in SI, (n, count).
            within: time from the first reading in which readings are counted [s].
        """
        beyond = (values < self.allowed.low) | (values > self.allowed.high)
        shown = np.isfinite(time)[:, None] & (np.abs(values) > self._least)
        if not shown.any():
            return beyond, False
        first = np.where(shown.any(axis=0), time[shown.argmax(axis=0)], math.nan)
        self.begin = np.where(np.isnan(self.begin), first, self.begin)
        late = shown & (time[:, None] >= self.begin + within)
        counted = shown & ~(np.maximum.accumulate(late, axis=0))
        self._shown += counted.sum(axis=0)
        self._beyond += (counted & beyond).sum(axis=0)
        self._sum += np.where(counted & beyond, values, 0.0).sum(axis=0)
        return beyond, bool(late.any())

    def refusals(self) -> Iterator[tuple[int, str]]:
        """Gearboxes most of whose readings were beyond the limits, with a line."""
        for n in np.flatnonzero(2.0 * self._beyond > self._shown):
            count, mean = int(self._beyond[n]), self._sum[n] / self._beyond[n]
            yield (
                int(n),
                (
                    f"{self.sensor.name} = {mean:.4g} {self.sensor.unit} in {count} of "
                    f"{int(self._shown[n])} readings: {self.sensor.refusal(self.allowed)}"
                ),
            )


class ReadingCheck:
    """Judges readings in the order of their arrival.

    Args:
        train: gear train of the scene.
        sensors: accuracy of the sensors, and factors that the readings have; a code has none.
        count: number of gearboxes.
        within: time from the first reading of a channel after which it is refused if most of its
            readings are impossible [s]; infinite: `refusals` is called instead.
    """

    def __init__(
        self, train: FollowedTrain, sensors: Sensors, count: int = 1, within: float = CHECKED
    ) -> None:
        self.left_out, self.stops = [LeftOut() for _ in range(count)], LeftOut()
        """What is left out, of each gearbox; and speeds of 0 that were found wrong too late."""
        self.stopped: list[tuple[str, NDArray[np.int64]]] = []
        """Channels and rows of the latter that the last call of `judge` found."""
        self._train, self._scale, self._count = train, sensors.scale, count
        self._within, self._done = within, set[str]()
        self._limits = {name: _Limits(one, train, count) for name, one in SENSORS.items()}
        self._torque_change = torque_change(sensors, train)
        self._rows: dict[str, int] = {}  # so far, by sender
        self._codes: dict[tuple[str, str], Codes] = {}
        self._pulses: dict[tuple[str, str], Pulses] = {}
        self._repeats: dict[str, Repeats] = {}

    def judge(self, time: Array, columns: Mapping[str, Array], sender: str) -> dict[str, Array]:
        """Judge readings of a sender.

        Args:
            time: stamps [s], (n,).
            columns: readings in SI by channel, (n, count) each; NaN where one is missing.
            sender: name of the sender.

        Returns:
            The readings, NaN where one is left out.

        Raises:
            InputError: most readings of a channel are beyond the limits of the scene from the
                start.
        """
        rows = self._rows.get(sender, 0) + np.arange(1.0, len(time) + 1.0)
        self._rows[sender] = self._rows.get(sender, 0) + len(time)
        kept = {name: np.array(given, dtype=float) for name, given in columns.items()}
        self.stopped = []
        if not len(time):
            return kept
        for name, values in kept.items():
            values[np.isinf(values)] = math.nan
            read, key = (time, values, rows), (sender, name)
            if key not in self._codes:
                sensor = SENSORS[name]
                common = sensor.nominal(self._train), self._scale.get(name, 1.0), self._count
                self._codes[key] = Codes(sensor, *common)
            self._omit(name, CODE, self._codes[key].judge(values), read)
            limits = self._limits[name]
            beyond, over = limits.judge(time, values, self._within)
            self._omit(name, limits.sensor.beyond(limits.allowed), beyond, read)
            if over:
                self._conclude(name)
            if SENSORS[name].quantity == "speed" and self._count == 1:  # rows of a fleet are slow
                self._judge_pulses(key, read)
        if set(TORQUES) <= set(kept):
            change, ratio = self._torque_change, self._train.ratio
            repeats = self._repeats.setdefault(sender, Repeats(change, ratio, self._count))
            stuck = repeats.judge(*(kept[name] for name in TORQUES))
            for name, which in zip(TORQUES, stuck, strict=True):
                self._omit(name, STUCK, which, (time, kept[name], rows))
        return kept

    def finish(self) -> None:
        """Judge channels with few readings, at the end of a recording.

        Raises:
            InputError: see `judge`.
        """
        for name in SENSORS:
            self._conclude(name)

    def refusals(self) -> dict[int, str]:
        """A line for each gearbox with a channel most of whose readings since the last call were
        beyond the limits of the scene."""
        found = dict(one for limits in self._limits.values() for one in limits.refusals())
        for limits in self._limits.values():
            limits.restart()
        return found

    def _conclude(self, name: str) -> None:
        """Refuse a channel most of whose first readings are impossible."""
        if name not in self._done:
            self._done.add(name)
            for _, line in self._limits[name].refusals():
                raise InputError(line)

    def _judge_pulses(self, key: tuple[str, str], read: tuple[Array, Array, Array]) -> None:
        """Leave out speeds with extra or lost pulses, and name stops that no shaft makes."""
        time, values, rows = read
        name = key[1]
        least = MOVING * SENSORS[name].nominal(self._train)
        pulses = self._pulses.setdefault(key, Pulses(least))
        for reason, which in pulses.judge(time, values[:, 0], rows).items():
            self._omit(name, reason, which[:, None], read)
        for stamps, numbers in pulses.stops:
            self.stops.add(name, STOPS, stamps, np.zeros(len(stamps)), numbers)
            self.stopped.append((name, numbers.astype(np.int64)))

    def _omit(self, name: str, reason: str, which: Mask, read: tuple[Array, Array, Array]) -> None:
        time, values, rows = read
        which = which & np.isfinite(time)[:, None]
        for n in np.flatnonzero(which.any(axis=0)):
            wrong = which[:, n]
            self.left_out[n].add(name, reason, time[wrong], values[wrong, n], rows[wrong])
        values[which] = math.nan
