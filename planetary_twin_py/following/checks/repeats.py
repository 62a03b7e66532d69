"""Recognises a torque that repeats one value exactly while the other torque changes.

A sensor that measures is noisy. One that repeats its last value, or the end of its range, is stuck
as soon as the load moves; a constant torque of a simulation or a set point is not. Where one torque
is constant, as of a motor at the end of its range, friction can move the other by about the loss.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

STUCK = "the value repeats exactly while the other torque changes"
FEWEST = 10  # equal readings in a row
LONGER = 10  # times as long as any such run before
SEEN = 100  # readings before, from which the usual runs are known


class Repeats:
    """Judges pairs of torques in the order of time.

    `moved` is the change of each torque that shows a change of the load [N m], and `ratio` the
    speed of the output over that of the input.
    """

    def __init__(self, moved: tuple[float, float], ratio: float, count: int = 1) -> None:
        self._moved = np.array(moved)[:, None, None]
        self._at_input = np.array([1.0, ratio])[:, None, None]  # both torques referred to the input
        self._last = np.full((2, 1, count), np.nan)
        self._run = np.zeros((2, 1, count), dtype=np.int64)  # equal readings up to the last
        self._longest = np.zeros((2, 1, count), dtype=np.int64)  # run before the present one
        self._at_start = np.full((2, 1, count), np.nan)  # the other torque at the start of the run
        self._rows = 0

    def judge(self, input_torque: Array, output_torque: Array) -> tuple[Mask, Mask]:
        """Masks of the readings of each torque [N m], (rows, n), that are stuck."""
        read = np.stack([input_torque, output_torque])
        number = np.arange(1, read.shape[1] + 1)[:, None]
        with_last = np.concatenate([self._last, read], axis=1)
        new = with_last[:, 1:] != with_last[:, :-1]
        start = np.maximum.accumulate(np.where(new, number, 0), axis=1)
        run = np.where(start > 0, number - start + 1, self._run + number)
        before = np.concatenate([self._run, run[:, :-1]], axis=1)
        longest = np.maximum(self._longest, np.maximum.accumulate(np.where(new, before, 0), axis=1))
        long = (run >= FEWEST) & (run >= LONGER * longest) & (read != 0.0)
        long &= (number + self._rows > SEEN) & np.isfinite(read)
        self._rows += read.shape[1]
        other = read[::-1]
        at_start = np.take_along_axis(other, np.maximum(start - 1, 0), axis=1)
        at_start = np.where(start > 0, at_start, self._at_start)
        loss = np.abs(self._at_input * read + self._at_input[::-1] * at_start)
        enough = np.maximum(self._moved[::-1], loss / np.abs(self._at_input[::-1]))
        stuck = long & (np.abs(other - at_start) > enough)
        self._last, self._run, self._longest = read[:, -1:], run[:, -1:], longest[:, -1:]
        self._at_start = at_start[:, -1:]
        return np.asarray(stuck[0]), np.asarray(stuck[1])
