"""Leaves out readings that are codes, that no machine reaches, or of doubled or missing pulses.

These are facts about a channel, and never events of the gearbox. Rows are those of one gearbox that
is followed, or of many in a fleet.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ...recording.tables.codes import equals_code
from ..channels.all import SENSORS, TORQUES
from ..channels.sensor import Sensor
from ..input_error import InputError
from ..sensors import Sensors, torque_change
from ..train import FollowedTrain
from .checks import CHECKED
from .left_out import LeftOut
from .pulses import Pulses
from .repeats import STUCK, Repeats

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

CODE = "the value is a code for a missing or saturated reading"
STOPS = "it jumps to 0 and back between two readings, as no shaft with inertia does"
FAR = 0.5  # relative change of a reading above which it may be a code


class _Channel:
    """Readings of a channel of a sender, of each gearbox; a code has no scale."""

    def __init__(self, name: str, train: FollowedTrain, scale: float, count: int) -> None:
        sensor = SENSORS[name]
        self._name, self.allowed, self._scale = name, sensor.limits(train), scale
        self._nominal = sensor.nominal(train)
        self._least = sensor.shown * self._nominal
        self._usual = np.full(count, math.nan)  # last reading that equals no code
        self._begin = np.full(count, math.nan)  # [s] of the readings that are counted
        self._counts = np.zeros((3, count))  # shown, beyond the limits, and the sum of these
        self._ends_beyond = np.zeros(count, dtype=bool)  # the last reading
        self.pulses = Pulses(self._least)
        self.concluded = False

    @property
    def sensor(self) -> Sensor:
        """The sensor of the channel; it is no part of the state, which can be pickled."""
        return SENSORS[self._name]

    def codes(self, values: Array) -> Mask:
        """Which readings, (n, count), are codes: a channel that passes a code's value has none."""
        given, equal = values / self._scale, np.zeros(values.shape, dtype=bool)
        written = [given * factor + offset for factor, offset in self.sensor.written]
        codes = [equals_code(number) for number in written]
        if self.sensor.quantity == "temperature":  # a thermometer without signal is at 0 degC
            codes = [code | (number == 0.0) for code, number in zip(codes, written, strict=True)]
        usual = np.isfinite(values) & ~np.any(codes, axis=0)
        row = np.where(usual, np.arange(len(values))[:, None], -1)
        last = np.maximum.accumulate(row, axis=0)
        before = np.take_along_axis(given, np.maximum(last, 0), axis=0)
        before = np.where(last >= 0, before, self._usual)
        self._usual = before[-1]
        before = np.where(np.isnan(before), np.copysign(self._nominal / self._scale, given), before)
        for code, number, (factor, offset) in zip(codes, written, self.sensor.written, strict=True):
            if code.any():
                expected = before * factor + offset
                equal |= code & ~(np.abs(number - expected) <= FAR * np.abs(expected))
        return equal

    def beyond(self, time: Array, values: Array, within: float) -> tuple[Mask, bool]:
        """Which readings are beyond the limits, and whether one is later than those that count."""
        beyond = (values < self.allowed.low) | (values > self.allowed.high)
        shown = np.isfinite(time)[:, None] & (np.abs(values) > self._least)
        first = np.where(shown.any(axis=0), time[shown.argmax(axis=0)], math.nan)
        self._begin = np.where(np.isnan(self._begin), first, self._begin)
        late = shown & (time[:, None] >= self._begin + within)
        counted = shown & ~np.maximum.accumulate(late, axis=0)
        wrong = counted & beyond
        last = len(time) - 1 - shown[::-1].argmax(axis=0)
        ends = beyond[last, np.arange(beyond.shape[1])]
        self._ends_beyond = np.where(shown.any(axis=0), ends, self._ends_beyond)
        self._counts += [counted.sum(axis=0), wrong.sum(axis=0), np.where(wrong, values, 0).sum(0)]
        return beyond, bool(late.any())

    def refusals(self) -> dict[int, str]:
        """A line for each gearbox most of whose readings since the last call were impossible, and
        still are: those of an outage that is over are left out only."""
        (shown, beyond, total), self._counts = self._counts, np.zeros_like(self._counts)
        return {
            n: f"{self.sensor.name} = {total[n] / beyond[n]:.4g} {self.sensor.unit} in "
            f"{beyond[n]:.0f} of {shown[n]:.0f} readings: {self.sensor.refusal(self.allowed)}"
            for n in np.flatnonzero((2.0 * beyond > shown) & self._ends_beyond).tolist()
        }


class ReadingCheck:
    """Judges readings in the order of their arrival.

    Args:
        train: gear train of the scene.
        sensors: accuracy of the sensors, and factors that the readings have.
        count: number of gearboxes.
        within: time from the first reading of a channel after which it is refused if most of its
            readings are impossible [s]; infinite: see `refusals`.
    """

    def __init__(
        self, train: FollowedTrain, sensors: Sensors, count: int = 1, within: float = CHECKED
    ) -> None:
        self.left_out, self.stops = [LeftOut() for _ in range(count)], LeftOut()
        """What is left out, of each gearbox; and speeds of 0 that were found wrong too late."""
        self.stopped: list[tuple[str, NDArray[np.int64]]] = []
        """Channels and rows of the latter that the last call of `judge` found."""
        self._train, self._sensors, self._count = train, sensors, count
        self._within = within
        self._rows: dict[str, int] = {}  # so far, by sender
        self._channels: dict[tuple[str, str], _Channel] = {}
        self._repeats: dict[str, Repeats] = {}

    def judge(self, time: Array, columns: Mapping[str, Array], sender: str) -> dict[str, Array]:
        """The readings of a sender by channel in SI, (n, count) each, NaN where one is left out.

        Raises `InputError` if most readings of a channel are beyond the limits of the scene from
        the start.
        """
        rows = self._rows.get(sender, 0) + np.arange(1.0, len(time) + 1.0)
        self._rows[sender] = self._rows.get(sender, 0) + len(time)
        kept = {name: np.array(given, dtype=float) for name, given in columns.items()}
        self.stopped = []
        if not len(time):
            return kept
        for name, values in kept.items():
            values[np.isinf(values)] = math.nan
            read, channel = (time, values, rows), self._channel(sender, name)
            self._omit(name, CODE, channel.codes(values), read)
            beyond, late = channel.beyond(time, values, self._within)
            self._omit(name, f"it exceeds {channel.allowed.limit}", beyond, read)
            if late:
                _conclude(channel)
            if channel.sensor.quantity == "speed" and self._count == 1:  # rows of fleets are slow
                self._judge_pulses(channel, read)
        if set(TORQUES) <= set(kept):
            stuck = self._repeats_of(sender).judge(*(kept[name] for name in TORQUES))
            for name, which in zip(TORQUES, stuck, strict=True):
                self._omit(name, STUCK, which, (time, kept[name], rows))
        return kept

    def finish(self) -> None:
        """Judge channels with few readings, at the end of a recording."""
        for channel in self._channels.values():
            _conclude(channel)

    def refusals(self) -> dict[int, str]:
        """A line for each gearbox with a channel most of whose readings since the last call were
        beyond the limits of the scene."""
        return dict(
            one for channel in self._channels.values() for one in channel.refusals().items()
        )

    def _channel(self, sender: str, name: str) -> _Channel:
        if (sender, name) not in self._channels:
            scale = self._sensors.scale.get(name, 1.0)
            channel = _Channel(name, self._train, scale, self._count)
            self._channels[sender, name] = channel
        return self._channels[sender, name]

    def _repeats_of(self, sender: str) -> Repeats:
        if sender not in self._repeats:
            change = torque_change(self._sensors, self._train)
            self._repeats[sender] = Repeats(change, self._train.ratio, self._count)
        return self._repeats[sender]

    def _judge_pulses(self, channel: _Channel, read: tuple[Array, Array, Array]) -> None:
        """Leave out speeds with extra or lost pulses, and name stops that no shaft makes."""
        (time, values, rows), name = read, channel.sensor.name
        for reason, which in channel.pulses.judge(time, values[:, 0], rows).items():
            self._omit(name, reason, which[:, None], read)
        for stamps, numbers in channel.pulses.stops:
            self.stops.add(name, STOPS, stamps, np.zeros(len(stamps)), numbers)
            self.stopped.append((name, numbers.astype(np.int64)))

    def _omit(self, name: str, reason: str, which: Mask, read: tuple[Array, Array, Array]) -> None:
        time, values, rows = read
        which = which & np.isfinite(time)[:, None]
        for n in np.flatnonzero(which.any(axis=0)):
            wrong = which[:, n]
            self.left_out[n].add(name, reason, time[wrong], values[wrong, n], rows[wrong])
        values[which] = math.nan


def _conclude(channel: _Channel) -> None:
    """Refuse a channel most of whose first readings are impossible."""
    if not channel.concluded:
        channel.concluded = True
        for line in channel.refusals().values():
            raise InputError(line)
