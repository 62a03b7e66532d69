"""Judges the stamps of the rows of a table: not set, repeated, or of a clock that was set back."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FEW = 20  # steps back above which the rows of a table are in any order
EPOCH = np.datetime64(0, "s")  # 1970
HALF_HOUR = 1800.0  # [s]; clocks are set by multiples of it
NEAR = 1.5  # usual steps by which such a step back may differ


class _Back(NamedTuple):
    """A step of the stamps back in time."""

    row: int  # index of the first row after it
    by: float  # [s]
    repeated: int  # rows after it whose times lie between those before


def unset_stamps(time: Array) -> NDArray[np.bool_]:
    """Which stamps, in the order of the rows, are 0 between rising ones: they were never set."""
    zero = time == 0.0
    others = np.flatnonzero(np.isfinite(time) & ~zero)
    if not zero.any() or len(others) < 2:
        return np.zeros(len(time), dtype=bool)
    if np.sum(np.diff(time[others]) < 0.0) > FEW:
        return np.zeros(len(time), dtype=bool)
    place = np.searchsorted(others, np.arange(len(time)))
    before = time[others[np.maximum(place - 1, 0)]]
    after = time[others[np.minimum(place, len(others) - 1)]]
    return np.asarray(zero & (place > 0) & (before > 0.0) & (after >= before))


def absolute_stamps(time: Array, begin: float) -> Array:
    """Stamps from 1970 on, the same in every part of a table with dates, to a microsecond.

    A table without dates has a `begin` of 0 s.
    """
    return np.round((time + begin) * 1e6) / 1e6 if begin else time


def begin_of(date: np.datetime64 | None) -> float:
    """Seconds from 1970 to a date; 0 without one."""
    return 0.0 if date is None else float((date - EPOCH) / np.timedelta64(1, "s"))


def stamp_remarks(time: Array, rows: NDArray[np.int64] | None = None) -> Iterator[str]:
    """Lines on stamps (n,) of one sender that step back or repeat; `rows` are their numbers.

    Raises `ValueError` if all stamps are equal, or if a clock seems to have been set back for the
    end of daylight saving, so that times are ambiguous.
    """
    if len(time) < 3:
        return
    if not np.ptp(time):
        raise ValueError(
            f"time: all {len(time)} stamps are {time[0]:g} s; were they never set, as header.stamp "
            "of a message?"
        )
    number = np.arange(1, len(time) + 1) if rows is None else rows
    for back in _steps_back(time):
        row, rising = int(number[back.row]), np.diff(time)
        usual = float(np.median(rising[rising > 0.0]))
        hours = round((back.by + usual) / HALF_HOUR)
        line = f"time steps back by {back.by:g} s at row {row}"
        if back.repeated > 1 and hours and abs(back.by + usual - hours * HALF_HOUR) < NEAR * usual:
            raise ValueError(
                f"{line}, and {back.repeated} rows repeat times: is it local time at the end of "
                "daylight saving? Write UTC, or dates with their offset, such as 2026-10-25 "
                "02:30:00+01:00"
            )
        order = "rows are used in the order of their stamps"
        repeats = f", and {back.repeated} rows lie between earlier ones" * (back.repeated > 0)
        yield f"{line}{repeats}: {order}; was a clock set?"


def _steps_back(time: Array) -> list[_Back]:
    """Steps back of stamps that rise otherwise; none of a table in any order."""
    back = np.flatnonzero(np.diff(time) < 0.0) + 1
    if not len(back) or len(back) > FEW or 2 * len(back) > len(time):
        return []
    found = []
    for row, end in zip(back, [*back[1:], len(time)], strict=True):
        earlier, later = time[:row], time[row:end]
        inside = (later >= earlier.min()) & (later <= earlier.max())
        found.append(_Back(int(row), float(time[row - 1] - time[row]), int(inside.sum())))
    return found
