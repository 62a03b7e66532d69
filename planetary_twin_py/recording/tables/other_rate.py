"""Compares the time stamps of a table with a sample rate that replaces them."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def other_rate(
    stated: Callable[[], Array], heading: str, rate: float, part: slice
) -> Iterator[str]:
    """A remark if a column of times contradicts the sample rate that replaces it.

    Args:
        stated: gives the time stamps [s], (rows,).
        heading: of their column.
        rate: the sample rate [Hz].
        part: rows that are used.
    """
    try:
        stamps = stated()[part]
    except ValueError:
        return  # times that nobody can read contradict nothing
    rows = np.flatnonzero(np.isfinite(stamps))
    known = stamps[rows]
    if len(rows) < 2 or not known[-1] > known[0]:
        return
    steps = np.diff(known)
    # Equal stamps in successive rows are rounded to the next longer step.
    rounding = max(float(steps[steps > 0.0].min()), 1.0 / rate)
    away = np.abs(known - known[0] - (rows - rows[0]) / rate)
    if float(away.max()) > rounding:
        yield (
            f"--sample-rate = {rate:g} Hz contradicts the column {heading!r}, "
            f"{_contradiction(known, rows, rate, away)}: all frequencies are those of "
            "--sample-rate; omit it if the stamps are right"
        )


def _contradiction(known: Array, rows: NDArray[np.intp], rate: float, away: Array) -> str:
    """What is different in stamps of another sample rate, or with single wrong rows.

    Args:
        known: time stamps [s], (n,).
        rows: their rows from 0, (n,).
        rate: the sample rate [Hz].
        away: deviations of the stamps from this rate [s], (n,).
    """
    stated = (rows[-1] - rows[0]) / (known[-1] - known[0])
    if f"{stated:.6g}" != f"{rate:.6g}":
        return f"whose stamps are {stated:.6g} Hz on average"
    for later in np.flatnonzero(np.diff(known) <= 0.0)[:1]:
        return f"whose stamp in row {rows[later + 1] + 1} is not later than the one before"
    worst = int(away.argmax())
    return f"whose stamp in row {rows[worst] + 1} is {away[worst]:.3g} s from equal steps"
