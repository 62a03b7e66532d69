"""Steps of the times of a table: equal ones, and those that look like days."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .rounded_stamps import UNEVEN, rounded_grid

Array = NDArray[np.float64]
DATE = "2026-11-22 10:00:00"  # example
_DAY_NUMBERS = 20_000.0, 80_000.0  # of a spreadsheet, from 1954 to 2119
_SHORT = 1e-3  # [s] step of readings, or a minute and a half in days


def day_numbers(time: Array) -> str:
    """Advice if times in seconds look like day numbers of a spreadsheet; empty otherwise.

    Args:
        time: times in their order [s], (rows,).
    """
    known = time[np.isfinite(time)]
    low, high = _DAY_NUMBERS
    if len(known) < 2 or known.min() < low or known.max() > high:
        return ""
    step = float(np.median(np.diff(known)))
    if not 0.0 < step < _SHORT:
        return ""
    return (
        f"time is {known[0]:.10g} s with steps of {step:.3g} s: are these day numbers of a "
        f"spreadsheet? Then write dates, such as {DATE}"
    )


def time_step(time: Array, first: int = 0) -> float:
    """The step of equally spaced time stamps, which may be rounded (see `rounded_grid`).

    Args:
        time: time stamps [s], (rows,).
        first: number of rows before these, for messages.

    Returns:
        The step [s].

    Raises:
        ValueError: the stamps decrease or are not equally spaced.
    """
    if len(time) < 2:
        raise ValueError(f"{len(time)} rows: must be at least 2, to determine the time step")
    if (grid := rounded_grid(time)) is not None:
        time = grid.time
    steps = np.diff(time)
    for k in np.flatnonzero(~(steps > 0.0))[:1]:
        raise ValueError(
            f"row {first + k + 2}: time = {time[k + 1]:.9g} s: must be later than {time[k]:.9g} s "
            "in the previous row"
        )
    usual = float(np.median(steps))
    for k in np.flatnonzero(np.abs(steps - usual) > UNEVEN * usual)[:1]:
        raise ValueError(
            f"row {first + k + 2}: time = {time[k + 1]:.9g} s: is {steps[k]:.6g} s after the "
            f"previous row, must be {usual:.6g} s (the median step), to within {UNEVEN:.0%}"
        )
    return float((time[-1] - time[0]) / len(steps))
