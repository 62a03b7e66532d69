"""Recognises the codes that loggers and converters write for a missing or saturated reading."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

CODES = np.sort(
    [
        *(sign * value for value in (999.0, 9999.0, 99999.0, 999999.0) for sign in (-1.0, 1.0)),
        -99.0, -888.0, -8888.0, -7999.0, -6999.0, 32767.0, -32768.0, 32768.0, 65535.0,
        8388607.0, -8388608.0, 2147483647.0, -2147483648.0, 4294967295.0,
    ]
)  # fmt: skip
EXACT = 1e-6  # relative error of a code after a conversion of its unit
USUAL = 8.0  # root mean squares of samples within which one may equal a code
HUGE = 1e30  # magnitude of a sample that is a code in any unit


def equals_code(values: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which numbers equal a code.

    Args:
        values: readings in the unit in which they were written, any shape.
    """
    whole = np.rint(values)
    code = CODES[np.minimum(np.searchsorted(CODES, whole), len(CODES) - 1)]
    return np.asarray((whole == code) & (np.abs(values - whole) <= EXACT * np.abs(code)))


def far_codes(
    values: NDArray[np.float64], squares: NDArray[np.float64], count: NDArray[np.float64]
) -> tuple[NDArray[np.bool_], NDArray[np.float64], NDArray[np.float64]]:
    """Which samples are codes, and far from those before them: a signal may pass a code's value.

    Args:
        values: samples in any unit, (n, channels); NaN where one is missing.
        squares: sums of the squares of the samples before, (channels,).
        count: their numbers, (channels,).

    Returns:
        Which samples, (n, channels), and both sums with these samples.
    """
    huge = ~(np.abs(values) < HUGE)
    equal = huge | equals_code(np.where(huge, 0.0, values))
    sums = squares + np.cumsum(np.where(equal, 0.0, values) ** 2, axis=0)
    counts = count + np.cumsum(~equal, axis=0)
    with np.errstate(over="ignore"):
        far = values**2 > USUAL**2 * sums / np.maximum(counts, 1.0)
    return equal & (huge | far), *((sums[-1], counts[-1]) if len(values) else (squares, count))
