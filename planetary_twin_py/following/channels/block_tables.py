"""What tables of samples have in common: an order by stamps, and a second 0."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...recording.tables.measurements import Column

AHEAD = 1.0  # [s]; a single stamp that is later than both of its neighbours by more is wrong
SPARSE = 10.0  # median steps from all other rows beyond which a stamp may be wrong


def order_of(time: NDArray[np.float64]) -> NDArray[np.int64]:
    """Rows in the order of their stamps; those without a stamp are last.

    A table is complete, so no row is late in it. Wrong stamps stay where they are among the others,
    so that a follower recognises them.
    """
    if not np.any(np.diff(time[np.isfinite(time)]) < 0.0):
        return np.arange(len(time))
    key = time.copy()
    wrong = _wrong_stamps(key)
    earlier = np.fmax.accumulate(np.where(wrong, -np.inf, key))
    key[wrong] = earlier[wrong]
    return np.argsort(key, kind="stable")


def _wrong_stamps(time: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Stamps ahead of both neighbours, and far from all that are not, (rows,).

    In a table in any order many stamps are ahead of both neighbours: those are right that a chain
    of close stamps connects with another.
    """
    known = np.flatnonzero(np.isfinite(time))
    stamps = time[known]
    beside = np.concatenate([[-np.inf], stamps, [-np.inf]])
    jump = stamps > np.maximum(beside[:-2], beside[2:]) + AHEAD
    order = np.argsort(stamps, kind="stable")
    steps = np.diff(stamps[order])
    far = max(AHEAD, SPARSE * float(np.median(steps)))
    group = np.concatenate([[0], np.cumsum(steps > far)])  # of stamps close to each other
    usual = np.bincount(group, ~jump[order]) > 0
    wrong = np.zeros(len(time), dtype=bool)
    wrong[known[order]] = usual.any() & ~usual[group]
    return wrong


def time_shift(path: Path, time: Column, begin: np.datetime64 | None) -> float:
    """Seconds from the second 0 of the readings, `begin` or no date, to that of another table.

    Raises `ValueError` if only the other table has dates.
    """
    if time.begin is None:
        return 0.0
    if begin is None:
        raise ValueError(
            f"{path}: time: has dates, but the readings have seconds: use one of these in both"
        )
    return float((time.begin - begin) / np.timedelta64(1, "s"))
