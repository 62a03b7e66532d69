"""Where a long recording is shown in every detail, and how the rest of it is summed up.

The whole run is always there as an overview of a few thousand rows, more than a screen has pixels.
Single samples and single intervals are spent where something happens: from the start on and after
every change of the operating point; or in the stretch that is asked for.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..recording.runs.reader import Recording, Series
from ..recording.runs.waveform import Stretch

MOST_SAMPLES = 750_000  # 15 s at 50 kHz: some 55 MB of a file, which the viewer opens in a second
MOST_ROWS = 4_000  # of the overview, besides those in detail
_BEFORE = 0.1  # share of a stretch before the change
_SHORTEST = 0.1  # [s] of a stretch: some hundred mesh cycles
# How intervals are summed up, by the end of a field's name: peaks are to stay, and what holds at
# the end of an interval holds at the end of several; all else is a mean.
_SUM = ("interval",)
_LARGEST = ("_peak",)
_SQUARE = ("_rms",)
_LAST = ("_angle", "_time", "sequence", "planets")


def stretches(recording: Recording) -> list[Stretch]:
    """Where `recording` is shown sample by sample: all of it, if `MOST_SAMPLES` reach for that."""
    begin, end = recording.state.time.min(), recording.state.time.max()
    begin = max(begin - recording.state["interval"][0], 0.0)
    ranges = recording.ranges
    room = math.inf if ranges is None else MOST_SAMPLES * ranges.period.min()
    if end - begin <= room:
        return [(begin, end)]
    happened = np.unique(np.append(begin, recording.operating_point.time))
    happened = happened[: math.floor(room / _SHORTEST)]
    length = room / len(happened)
    found: list[Stretch] = []
    for instant in happened:
        first, last = max(instant - _BEFORE * length, begin), min(instant + length, end)
        if found and first <= found[-1][1]:
            first, _ = found.pop()
        found.append((first, last))
    return found


def overview(recording: Recording, detail: list[Stretch]) -> Recording:
    """The same with fewer states: intervals outside of `detail` are summed up."""
    begins = first_rows(recording.state.time, detail)
    return replace(recording, state=_summed_up(recording.state, begins))


def first_rows(time: NDArray[np.float64], detail: list[Stretch]) -> NDArray[np.intp]:
    """First row of each group that makes one row of the overview; in `detail` each is its own."""
    step = math.ceil(len(time) / MOST_ROWS)
    single = np.zeros(len(time) + 1, dtype=bool)
    for begin, end in detail:
        single[:-1] |= (begin <= time) & (time <= end)
    single[1:] |= single[:-1]  # the row behind begins a group, too
    return np.flatnonzero(single[:-1] | (np.arange(len(time)) % step == 0))


def _summed_up(state: Series, begins: NDArray[np.intp]) -> Series:
    last = np.append(begins[1:], len(state)) - 1
    columns = {name: _column(name, values, begins, last) for name, values in state.columns.items()}
    return Series(state.time[last], state.stamp[last], columns)


def _column(
    name: str, values: NDArray[Any], begins: NDArray[np.intp], last: NDArray[np.intp]
) -> NDArray[Any]:
    if name.endswith(_LAST):
        return values[last]
    if name.endswith(_LARGEST):
        return np.fmax.reduceat(values, begins, axis=0)
    if name.endswith(_SUM):
        return np.add.reduceat(values, begins, axis=0)
    if name.endswith(_SQUARE):
        return np.sqrt(_mean(values**2, begins))
    return _mean(values, begins)


def _mean(values: NDArray[Any], begins: NDArray[np.intp]) -> NDArray[Any]:
    """Of what is a number in each group; NaN where nothing is."""
    known = np.isfinite(values)
    total = np.add.reduceat(np.where(known, values, 0.0), begins, axis=0)
    count = np.add.reduceat(known.astype(np.int64), begins, axis=0)
    return np.divide(total, count, out=np.full(total.shape, np.nan), where=count > 0)
