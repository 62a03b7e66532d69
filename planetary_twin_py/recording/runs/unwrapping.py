"""Continuous angles from recorded ones, which are modulo a turn."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_TURN = 2.0 * np.pi


def unwrap(
    time: NDArray[np.float64], angle: NDArray[np.float64], speed: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Continuous angle [rad] from `angle` modulo a turn and mean `speed` [rad/s] before each."""
    expected = speed[1:] * np.diff(time)
    step = np.diff(angle)
    turns = np.rint((expected - step) / _TURN)
    return angle[0] + np.concatenate(([0.0], np.cumsum(step + _TURN * turns)))
