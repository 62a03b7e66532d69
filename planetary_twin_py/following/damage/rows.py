"""Rows of readings that count for damage: their torque, speed, temperature and time."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...durability.damage_state import Last
from ..arrival.reading_spacing import last_steps, longest_steps
from ..channels.all import OIL

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

HELD = 2.0  # [s] for which a speed of another message is that of a torque
TORQUE_SD = "input_torque_std"
"""Column with the standard deviation of the input torque within a row."""


class Rows(NamedTuple):
    """Rows of some gearboxes, (m, n) each."""

    time: Array
    """Stamps [s]."""
    torque: Array
    """Input torque [N m]."""
    torque_sd: Array
    """Its standard deviation within the row [N m]; NaN if it is not given."""
    speed: Array
    """Input speed [rad/s]."""
    oil: Array
    """Oil temperature [K]: the last one that is known."""
    own_oil: Mask
    """Whether the row has a temperature of its own."""
    step: Array
    """Time since the reading before [s]; 0 where there is none."""
    known: Mask
    """Whether the time since the reading before is that of this reading."""
    gap: Mask
    """Whether it is a gap, of which nothing is known."""
    fresh: Mask
    """Whether it is a complete reading that is later than all before."""
    again: Mask
    """Whether the stamp is not later than that of a reading that has been used."""


class RowKeeper:
    """Forms rows from readings, with what was last known of each of some gearboxes.

    Args:
        ratio: speed of the output over that of the input.
        oil_temperature: of the scene [K], until one is measured.
        last: last readings of each gearbox; they are changed.
        usual: usual time between rows [s]; None: as the readings have it.
    """

    def __init__(
        self, ratio: float, oil_temperature: float, last: Sequence[Last], usual: float | None
    ) -> None:
        self._ratio, self._default = ratio, oil_temperature
        self._last, self._usual = last, usual

    def take(self, time: Array, columns: Mapping[str, Array]) -> Rows:
        """Form the rows of some readings.

        Args:
            time: stamps [s], (m,).
            columns: readings in SI by channel, (m, n) each; NaN where one is missing.
        """
        count = len(self._last)
        missing = np.full((len(time), count), math.nan)
        stamps = np.broadcast_to(time[:, None], missing.shape)
        torque = columns.get("input_torque", missing)
        speed = columns.get("input_speed", missing)
        if "output_speed" in columns:
            speed = np.where(np.isnan(speed), columns["output_speed"] / self._ratio, speed)
        speed, speed_time = self._held(stamps, speed)
        oil = columns.get(OIL, missing)
        own_oil = np.isfinite(oil)
        oil = _filled(np.where(np.isfinite(stamps), oil, math.nan), self._of("oil_temperature"))
        usable = np.isfinite(torque) & (np.abs(stamps - speed_time) <= HELD)
        before = np.concatenate(
            [
                np.nan_to_num(self._of("time"), nan=-math.inf)[None],
                np.where(usable, stamps, -math.inf),
            ]
        )
        newest = np.maximum.accumulate(before, axis=0)
        fresh = usable & (stamps > newest[:-1])
        follows = fresh & np.isfinite(newest[:-1])
        step = np.where(follows, stamps - np.where(follows, newest[:-1], 0.0), 0.0)
        gap = follows & (step > self._limits(step, follows))
        rows = Rows(
            stamps, torque, columns.get(TORQUE_SD, missing), speed,
            np.where(np.isnan(oil), self._default, oil), own_oil, step, follows & ~gap, gap,
            fresh, usable & ~fresh,
        )  # fmt: skip
        for n, last in enumerate(self._last):
            if math.isfinite(newest[-1, n]):
                last.time = float(newest[-1, n])
            if len(time):
                last.speed, last.speed_time = float(speed[-1, n]), float(speed_time[-1, n])
                last.oil_temperature = float(oil[-1, n])
        return rows

    def _of(self, name: str) -> Array:
        return np.array([getattr(last, name) for last in self._last])

    def _held(self, stamps: Array, speed: Array) -> tuple[Array, Array]:
        """Speeds that were last known at each row, and their stamps."""
        stamped = np.where(np.isfinite(speed), stamps, math.nan)
        speed = np.where(np.isfinite(stamps), speed, math.nan)
        return _filled(speed, self._of("speed")), _filled(stamped, self._of("speed_time"))

    def _limits(self, step: Array, follows: Mask) -> Array:
        """Longest steps that are no gaps [s], (m, n)."""
        if self._usual is not None:
            return longest_steps((self._usual,), np.zeros(1)) + 0.0 * step
        limits = np.zeros_like(step)
        for n, last in enumerate(self._last):
            steps = step[follows[:, n], n]
            limits[follows[:, n], n] = longest_steps(last.steps, steps)
            last.steps = last_steps(last.steps, steps)
        return limits


def _filled(values: Array, before: Array) -> Array:
    """Values with the last known one in place of NaN, (m, n); `before` is that before them."""
    every = np.concatenate([before[None], values])
    row = np.where(np.isfinite(every), np.arange(len(every))[:, None], 0)
    return np.take_along_axis(every, np.maximum.accumulate(row, axis=0), axis=0)[1:]
