"""Selects the parts of a long recording that are shown in detail, and aggregates the rest.

An overview of a few thousand rows, more than a screen has pixels, covers the whole run. Single
samples and intervals are shown after the start and after every change of the operating point, or
in the time span that the user gives.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..recording.runs.reader import Recording
from ..recording.runs.series import Series
from ..recording.runs.waveform import TimeSpan

MOST_SAMPLES = 750_000  # 15 s at 50 kHz: 55 MB, which the viewer opens in a second
MOST_ROWS = 4_000  # of the overview, without those in detail
_BEFORE = 0.1  # fraction of a span before the change
_SHORTEST = 0.1  # [s] of a span: about a hundred mesh cycles
# Aggregation of intervals by the suffix of a field: sum, maximum, rms or last value; all other
# fields are means.
_SUM = ("interval",)
_LARGEST = ("_peak",)
_SQUARE = ("_rms",)
_LAST = ("_angle", "_time", "sequence", "planets", "_orbit_x", "_orbit_y")


def detailed_spans(recording: Recording) -> list[TimeSpan]:
    """Time spans shown sample by sample: all of `recording`, if it has at most `MOST_SAMPLES`."""
    begin, end = recording.state.time.min(), recording.state.time.max()
    begin = max(begin - recording.state["interval"][0], 0.0)
    ranges = recording.ranges
    room = math.inf if ranges is None else MOST_SAMPLES * ranges.period.min()
    if end - begin <= room:
        return [(begin, end)]
    changes = np.unique(np.append(begin, recording.operating_point.time))
    changes = changes[: math.floor(room / _SHORTEST)]
    length = room / len(changes)
    spans: list[TimeSpan] = []
    for instant in changes:
        first, last = max(instant - _BEFORE * length, begin), min(instant + length, end)
        if spans and first <= spans[-1][1]:
            first, _ = spans.pop()
        spans.append((first, last))
    return spans


def overview(recording: Recording, detail: list[TimeSpan]) -> Recording:
    """Recording with fewer states: intervals outside `detail` are aggregated.

    Args:
        recording: the recording.
        detail: time spans [s] whose intervals are kept.
    """
    state, axes = (_fewer(series, detail) for series in (recording.state, recording.axes_state))
    return replace(recording, state=state, axes_state=axes)


def _fewer(series: Series, detail: list[TimeSpan]) -> Series:
    return _summed_up(series, first_rows(series.time, detail)) if len(series) else series


def first_rows(time: NDArray[np.float64], detail: list[TimeSpan]) -> NDArray[np.intp]:
    """First row of each group that is aggregated to one row; in `detail` a group is one row.

    Args:
        time: times of the rows [s], (n,).
        detail: time spans [s] whose rows are kept.
    """
    step = math.ceil(len(time) / MOST_ROWS)
    single = np.zeros(len(time) + 1, dtype=bool)
    for begin, end in detail:
        single[:-1] |= (begin <= time) & (time <= end)
    single[1:] |= single[:-1]  # the row after it starts a group, too
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
    """Mean of the finite values of each group; NaN if there are none."""
    known = np.isfinite(values)
    total = np.add.reduceat(np.where(known, values, 0.0), begins, axis=0)
    count = np.add.reduceat(known.astype(np.int64), begins, axis=0)
    return np.divide(total, count, out=np.full(total.shape, np.nan), where=count > 0)
