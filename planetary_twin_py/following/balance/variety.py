"""What readings lack to determine the parameters of the torque balance better."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..train import FollowedTrain
from .balances import F_T, F_W, B, D, F, G, J, Measured
from .filter import SLOW_FALL

Array = NDArray[np.float64]

LOADED = 0.2  # share of the torque of the scene that a torque of either sign needs for a reversal
MOVING = 0.05  # share of the speed of the scene that a speed of either sign needs for a reversal
SEVERAL = 1.5, 1.2  # ratios of largest to smallest torque and speed that are several ones
RELATED = 0.3  # correlation of two parameters above which separating them helps

TORQUE_REVERSAL = "a reversal of the torque"
ROTATION_REVERSAL = "a reversal of the rotation"
WITHOUT_LOAD = f"{ROTATION_REVERSAL}, or a run without load"
TORQUES, SPEEDS = "running at several torques", "running at several speeds"
SPEED_CHANGE = "a change of speed"
LONGER = "a longer run"
SEPARATED = {
    B: WITHOUT_LOAD, D: ROTATION_REVERSAL, G: TORQUE_REVERSAL, J: SPEED_CHANGE, F: TORQUES,
    F_T: TORQUES, F_W: SPEEDS,
}  # fmt: skip
"""Readings that separate a parameter from others."""


@dataclass
class _Extremes:
    """Lowest and highest values of some bins."""

    begin: float  # [s]
    low: Array  # torque, speed and their magnitudes, (4,)
    high: Array

    def add(self, values: Array) -> None:
        self.low, self.high = np.minimum(self.low, values), np.maximum(self.high, values)


@dataclass
class Variety:
    """Which torques and speeds the readings contain, since the start or the last step.

    Readings older than 1 to 2 h are forgotten, as the parameters are.
    """

    train: FollowedTrain
    _spans: list[_Extremes] = field(default_factory=list)  # the last one is being filled

    def restart(self) -> None:
        """Forget all readings, after a step that has made parameters uncertain."""
        self._spans.clear()

    def add(self, read: Measured) -> None:
        """Add a bin with torque and speed at the input."""
        torque, speed = float(read.input_torque[0]), float(read.speed[0])
        values = np.array([torque, speed, abs(torque), abs(speed)])
        if not self._spans or read.time - self._spans[-1].begin > SLOW_FALL:
            self._spans = [*self._spans[-1:], _Extremes(read.time, values, values)]
        self._spans[-1].add(values)

    def contains(self, remedy: str) -> bool:
        """Whether the readings already contain what a remedy asks for."""
        if not self._spans:
            return False
        low = np.min([span.low for span in self._spans], axis=0)
        high = np.max([span.high for span in self._spans], axis=0)
        torque, speed = LOADED * self.train.torque, MOVING * self.train.speed
        found = {
            TORQUE_REVERSAL: low[0] < -torque and high[0] > torque,
            ROTATION_REVERSAL: low[1] < -speed and high[1] > speed,
            TORQUES: high[2] > max(SEVERAL[0] * low[2], torque),
            SPEEDS: high[3] > max(SEVERAL[1] * low[3], speed),
        }
        found[WITHOUT_LOAD] = found[ROTATION_REVERSAL]
        found[SPEED_CHANGE] = found[SPEEDS]
        return bool(found.get(remedy, False))

    def remedy(self, state: int, covariance: Array, identified: bool) -> str:
        """The first remedy for a parameter that the readings lack; empty if they lack none."""
        for remedy in _remedies(state, covariance):
            if not self.contains(remedy):
                return remedy
        if identified:
            return ""
        return SPEED_CHANGE if state == J else LONGER


def _remedies(state: int, covariance: Array) -> Iterator[str]:
    """Remedies for a parameter, the most effective one first."""
    if state in (B, D):
        yield ROTATION_REVERSAL
        return
    if state in (G, J):
        yield SEPARATED[state]
        return
    sd = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    correlation = np.abs(covariance[state] / (sd * sd[state]))
    correlation[state] = 0.0
    for other in np.argsort(-correlation, kind="stable"):
        if correlation[other] >= RELATED:
            yield SEPARATED[int(other)]
    yield TORQUE_REVERSAL
    yield WITHOUT_LOAD
