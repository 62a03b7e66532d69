"""Leaves out readings that are codes, that no machine reaches, or of doubled or missing pulses."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .bins import CHANNELS
from .checks import CHECKED, InputError
from .contradictions import LOADED, MOVING
from .left_out import LeftOut
from .plausibility import OIL, Range, beyond, equals_code, leaps, ranges_of
from .pulses import Pulses
from .repeats import STUCK, Repeats
from .sensors import Sensors, torque_change
from .train import FollowedTrain

Array = NDArray[np.float64]

TORQUES = "input_torque", "output_torque"
CODE = "the value is a code for a missing or saturated reading"
STOPS = "it leaps to 0 and back between two readings, as no shaft with inertia does"
SPELLINGS = {
    "speed": "rad/s, rpm, deg/s or Hz", "torque": "N m, N mm, kN m or lbf ft",
}  # fmt: skip


@dataclass
class _First:
    """Readings of a channel before its unit is known to be possible."""

    begin: float = math.nan  # [s]
    possible: int = 0
    impossible: list[float] = field(default_factory=list)
    done: bool = False


def nominal_values(train: FollowedTrain) -> dict[str, float]:
    """Magnitudes of the readings at the operating point of a scene, by channel.

    Args:
        train: gear train of the scene.
    """
    torque, speed, ratio = train.torque, train.speed, abs(train.ratio)
    return {
        "input_torque": torque, "output_torque": torque / ratio,
        "input_speed": speed, "output_speed": speed * ratio, OIL: train.oil_temperature,
    }  # fmt: skip


def limit_text(name: str, allowed: Range) -> str:
    """Why a reading beyond a range is left out.

    Args:
        name: name of the channel.
        allowed: the range.
    """
    limit = f"{allowed.high:.4g} {CHANNELS[name]}"
    if name == OIL:
        return f"it must be within {allowed.low:g} and {limit} (messages are in degrees Celsius)"
    return f"it exceeds {allowed.limited_by}, {limit}"


def impossible_text(name: str, allowed: Range, values: Array, total: int) -> str:
    """What is said of a channel most of whose readings are beyond a range.

    Args:
        name: name of the channel.
        allowed: the range.
        values: the readings beyond it, in SI, (n,).
        total: number of all readings.
    """
    unit = CHANNELS[name]
    line = f"{name} = {np.median(values):.4g} {unit} in {len(values)} of {total} readings: "
    if name == OIL:
        return (
            f"{line}must be within {allowed.low:g} and {allowed.high:g} K; a column in degrees "
            f"Celsius is headed {name} [degC], and messages are in degrees Celsius"
        )
    return (
        f"{line}exceeds {allowed.limited_by} = {allowed.high:.4g} {unit}; is it in {unit}? A "
        f"heading states another unit ({SPELLINGS[name.split('_')[1]]}), as in {name} [UNIT], or "
        f"scale {name} by a factor"
    )


class ReadingCheck:
    """Judges readings in the order of their arrival.

    Args:
        train: gear train of the scene.
        sensors: accuracy of the sensors, and factors that the readings have; a code has none.
    """

    def __init__(self, train: FollowedTrain, sensors: Sensors) -> None:
        self.left_out, self.stops = LeftOut(), LeftOut()
        self.stopped: list[tuple[str, NDArray[np.int64]]] = []
        """Channels and rows with speeds of 0 that the last call of `judge` found wrong, too late to
        leave them out."""
        self._ranges = ranges_of(train)
        self._scale, self._ratio = sensors.scale, train.ratio
        self._changed = torque_change(sensors, train)
        self._repeats: dict[str, Repeats] = {}
        self._nominal = nominal_values(train)
        self._usual: dict[tuple[str, str], float] = {}
        self._rows: dict[str, int] = {}
        self._first = {name: _First() for name in CHANNELS}
        self._pulses: dict[tuple[str, str], Pulses] = {}

    def judge(self, time: Array, columns: Mapping[str, Array], sender: str) -> dict[str, Array]:
        """Judge readings of a sender.

        Args:
            time: stamps [s], (n,).
            columns: readings in SI by channel, (n,) each; NaN where one is missing.
            sender: name of the sender.

        Returns:
            The readings, NaN where one is left out.

        Raises:
            InputError: most readings of a channel are beyond the limits of the scene from the
                start.
        """
        rows = self._rows.get(sender, 0) + np.arange(1.0, len(time) + 1.0)
        self._rows[sender] = self._rows.get(sender, 0) + len(time)
        kept, self.stopped = {}, []
        for name, given in columns.items():
            values = np.array(given, dtype=float)
            values[np.isinf(values)] = math.nan
            self._omit(name, CODE, self._codes(name, sender, values), (time, values, rows))
            self._omit(name, *self._beyond(name, time, values), (time, values, rows))
            if name.endswith("speed"):
                least = MOVING * self._nominal[name]
                pulses = self._pulses.setdefault((sender, name), Pulses(least))
                for reason, which in pulses.judge(time, values, rows).items():
                    self._omit(name, reason, which, (time, values, rows))
                for stamps, numbers in pulses.stops:
                    self.stops.add(name, STOPS, stamps, np.zeros(len(stamps)), numbers)
                    self.stopped.append((name, numbers.astype(np.int64)))
            kept[name] = values
        if set(TORQUES) <= set(kept) and len(time):
            repeats = self._repeats.setdefault(sender, Repeats(self._changed, self._ratio))
            torques = kept[TORQUES[0]], kept[TORQUES[1]]
            stuck = repeats.judge(torques[0][:, None], torques[1][:, None])
            for name, which in zip(TORQUES, stuck, strict=True):
                self._omit(name, STUCK, which[:, 0], (time, kept[name], rows))
        return kept

    def finish(self) -> None:
        """Judge channels with few readings, at the end of a recording.

        Raises:
            InputError: see `judge`.
        """
        for name in CHANNELS:
            self._conclude(name)

    def _omit(
        self, name: str, reason: str, which: NDArray[np.bool_], read: tuple[Array, Array, Array]
    ) -> None:
        time, values, rows = read
        which &= np.isfinite(time)
        if which.any():
            self.left_out.add(name, reason, time[which], values[which], rows[which])
            values[which] = math.nan

    def _codes(self, name: str, sender: str, values: Array) -> NDArray[np.bool_]:
        """Which readings are codes."""
        equal = equals_code(name, values / self._scale.get(name, 1.0))
        usual = np.isfinite(values) & ~equal
        last = np.maximum.accumulate(np.where(usual, np.arange(len(values)), -1))
        found = equal
        if equal.any():
            before = self._usual.get((sender, name), math.nan)
            known = np.where(last >= 0, values[last], before)
            nominal = np.copysign(self._nominal[name], values)
            found = equal & leaps(values, np.where(np.isnan(known), nominal, known))
        if len(last) and last[-1] >= 0:
            self._usual[sender, name] = float(values[last[-1]])
        return found

    def _beyond(self, name: str, time: Array, values: Array) -> tuple[str, NDArray[np.bool_]]:
        """Why and which readings are beyond the limits of the scene."""
        allowed, first = self._ranges[name], self._first[name]
        found = beyond(values, allowed)
        if not first.done:
            least = {"torque": LOADED, "speed": MOVING}.get(name.split("_")[1], 0.0)
            shown = np.isfinite(time) & (np.abs(values) > least * self._nominal[name])
            for k in np.flatnonzero(shown):
                first.begin = float(time[k]) if math.isnan(first.begin) else first.begin
                if time[k] >= first.begin + CHECKED:
                    self._conclude(name)
                    break
                if found[k]:
                    first.impossible.append(float(values[k]))
                else:
                    first.possible += 1
        return limit_text(name, allowed), found

    def _conclude(self, name: str) -> None:
        """Refuse a channel most of whose first readings are impossible."""
        allowed, first = self._ranges[name], self._first[name]
        first.done = True
        if len(first.impossible) <= first.possible:
            return
        total = len(first.impossible) + first.possible
        raise InputError(impossible_text(name, allowed, np.array(first.impossible), total))
