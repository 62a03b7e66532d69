"""Continuous angles from recorded angles modulo a turn."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_TURN = 2.0 * np.pi


def unwrap(
    time: NDArray[np.float64], angle: NDArray[np.float64], speed: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Unwrap an angle, also if it advances by several turns between samples.

    Args:
        time: (n,) [s].
        angle: (n,) modulo a turn [rad].
        speed: (n,) mean speed before each sample [rad/s].

    Returns:
        Continuous angle (n,) [rad].
    """
    expected = speed[1:] * np.diff(time)
    step = np.diff(angle)
    turns = np.rint((expected - step) / _TURN)
    return angle[0] + np.concatenate(([0.0], np.cumsum(step + _TURN * turns)))
