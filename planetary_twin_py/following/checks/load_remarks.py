"""Names torques and speeds that are unlike those of the scene while the train turns.

A unit that is wrong in both torques, or in both speeds, leaves their ratio correct. A torque that
is exactly 0 for long is that of a sensor without signal: one that measures is noisy.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from ...scene import OperatingPoint
from ..channels.all import MOVING, TORQUES
from ..train import FollowedTrain
from .checks import CHECKED

Array = NDArray[np.float64]

SMALL = 0.005  # share of the torque of the scene; an idle gearbox usually takes more
FAST = 5.0  # multiple of the speed of the scene
FEWEST = 50  # rows in which the gearbox turns, from which torque and speed are judged
DEAD = 5  # rows in which a dead torque is 0, at least


class LoadRemarks:
    """Follows torques and speeds of the inputs of some gearboxes.

    A torque or speed of zero at the operating point is not compared. Rows are averaged over
    `length` [s].
    """

    def __init__(
        self, point: OperatingPoint, train: FollowedTrain, length: float, count: int = 1
    ) -> None:
        self._point, self._train = point, train
        self._fewest_zeros = max(CHECKED / length, DEAD)
        self._largest = np.zeros(count)  # [N m] magnitude of the input torque while turning
        self._speeds = np.zeros(count)  # [rad/s] sum of magnitudes while turning
        self._turning = np.zeros(count)  # rows
        self._since = {name: np.full(count, math.nan) for name in TORQUES}  # [s] begin of zeros
        self._zeros = {name: np.zeros(count) for name in TORQUES}  # rows while turning

    def add(self, begin: float, row: Mapping[str, Array]) -> None:
        """Add a row by its start [s], (count,) each in SI; NaN where a reading is missing."""
        missing = np.full(len(self._turning), math.nan)
        speed = row.get("input_speed", missing)
        if "output_speed" in row:
            speed = np.where(np.isnan(speed), row["output_speed"] / self._train.ratio, speed)
        turns = np.abs(speed) > MOVING * self._train.speed
        self._turning += turns
        self._speeds += np.where(turns, np.abs(speed), 0.0)
        load = np.abs(row.get("input_torque", missing))
        self._largest = np.fmax(self._largest, np.where(turns, load, 0.0))
        for name in TORQUES:
            values = row.get(name, missing)
            zero, dead = self._zeros[name], (values == 0.0) & turns
            zero[np.isfinite(values) & (values != 0.0)] = 0.0
            self._since[name] = np.where(dead & (zero == 0.0), begin, self._since[name])
            zero += dead

    def remarks(self, gearbox: int = 0) -> Iterator[str]:
        """Lines on the torques and speeds of a gearbox."""
        for name in TORQUES:
            if self._zeros[name][gearbox] >= self._fewest_zeros:
                yield (
                    f"{name} is exactly 0 since {self._since[name][gearbox]:.1f} s although the "
                    "train turns: is its sensor connected?"
                )
        if self._turning[gearbox] < FEWEST:
            return
        usual_torque, usual_speed = abs(self._point.input_torque), abs(self._point.input_speed)
        torque, speed = self._largest[gearbox], self._speeds[gearbox] / self._turning[gearbox]
        if 0.0 < torque < SMALL * usual_torque:
            yield (
                f"input_torque is at most {torque:.3g} N m, and that of the scene is "
                f"{usual_torque:.3g} N m: is the unit of both torques right? The field effort of a "
                "JointState is in N m; a table in kN m needs the heading input_torque [kN m]"
            )
        if usual_speed > 0.0 and speed > FAST * usual_speed:
            yield (
                f"input_speed is {speed:.4g} rad/s on average, {speed / usual_speed:.3g} times "
                "that of the scene: is the unit of both speeds right? The field velocity of a "
                "JointState is in rad/s; a table in rpm needs the heading input_speed [rpm]"
            )
