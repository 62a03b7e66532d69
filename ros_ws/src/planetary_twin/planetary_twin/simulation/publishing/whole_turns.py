"""Whole turns of the bodies of a gearbox, whose angles are given modulo one turn."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from planetary_twin_py import Window
from planetary_twin_py.recording.ros2.fields import TURN


class WholeTurns:
    """
    Counts whole turns from the first window of a run, which starts within half a turn of zero.

    The angles before and after a window and its mean speed determine one integer. Only this
    integer is added up, so there is no drift.
    """

    def __init__(self) -> None:
        self._end = np.nan  # [s] of the previous window
        self._angle: NDArray[np.float64] = np.empty(0)  # [rad]
        self._turns: NDArray[np.float64] = np.empty(0)

    def after(self, window: Window) -> NDArray[np.float64]:
        """Return the turns of each body at the end of `window`, shape (bodies,)."""
        if window.start != self._end:
            self._turns = self._angle = np.zeros_like(window.angle)
        turned = window.mean_speed * (window.end - window.start)
        self._turns = self._turns + np.rint((turned - window.angle + self._angle) / TURN)
        self._end, self._angle = window.end, window.angle
        return self._turns
