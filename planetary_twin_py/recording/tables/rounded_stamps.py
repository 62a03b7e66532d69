"""Time stamps at equal steps that are rounded to their last digit, such as 0.04, 0.08, 0.12 ms.

Steps of 0.0390625 ms that are rounded to 0.01 ms are 0.03 and 0.04 ms long. If one straight line
passes within half a digit of all stamps, their steps are equal: a missing row would shift all later
stamps by two digits or more.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

UNEVEN = 0.1  # relative deviation of a step, up to which stamps need no rounding to explain it
FEWEST = 64  # stamps that determine a step to a small part of a digit
COARSEST = 0.5  # of a step: digit with which a missing row shows
_EXACT = 1e-3  # of a digit: rounding error of a stamp in 64-bit numbers
_FIT = 4.0  # error of the straight line over a digit, times the root of the number of stamps


class Grid(NamedTuple):
    """Equal steps."""

    time: Array
    """[s], (n,)."""
    digit: float
    """To which the stamps are rounded [s]."""


def rounded_grid(time: Array) -> Grid | None:
    """The equal steps of rounded stamps; None if they do not fit, or the stamps are even.

    Args:
        time: time stamps [s], (n,).
    """
    if len(time) < FEWEST or not (np.isfinite(time).all() and time[-1] > time[0]):
        return None
    step, steps = float(time[-1] - time[0]) / (len(time) - 1), np.diff(time)
    usual = float(np.median(steps))
    if (np.abs(steps - usual) <= UNEVEN * usual).all():
        return None
    digit = 10.0 ** math.floor(math.log10(COARSEST * step))
    digits = time / digit
    if (np.abs(digits - np.rint(digits)) > _EXACT).any():
        return None
    number = np.arange(len(time)) / (len(time) - 1)
    fit = np.polynomial.Polynomial.fit(number, time, 1)(number)
    low, high = float((time - fit).min()), float((time - fit).max())
    if high - low > digit * (1.0 + _FIT / math.sqrt(len(time))):
        return None
    return Grid(fit + 0.5 * (low + high), digit)
