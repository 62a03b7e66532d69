"""Speed and torque of the input over time, from the bins of the torque balance."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Turning(NamedTuple):
    """Speed and torque over time."""

    time: Array
    """Middles of the bins [s], (n,)."""
    speed: Array
    """Speed of the input [rad/s], (n,)."""
    torque: Array
    """Torque of the input [N m], (n,)."""

    def angle(self, time: Array) -> Array:
        """Angle of the input since the first of some increasing times [s], [rad], (m,)."""
        return _integral(time, np.interp(time, self.time, self.speed))

    def end_of(self, angle: float, begin: float) -> float | None:
        """Time at which the input has turned by an angle [rad] since `begin`; None before."""
        later = self.time > begin
        if not later.any():
            return None
        first = float(np.interp(begin, self.time, self.speed))
        time = np.concatenate([[begin], self.time[later]])
        turned = _integral(time, np.abs(np.concatenate([[first], self.speed[later]])))
        if turned[-1] < angle:
            return None
        return float(np.interp(angle, turned, time))


def _integral(time: Array, speed: Array) -> Array:
    """Integral of a speed from the first time on, by trapezoids."""
    return np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time))])
