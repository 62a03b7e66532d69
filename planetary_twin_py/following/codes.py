"""Recognises the codes that loggers and converters write for a missing or saturated reading."""

from __future__ import annotations

from collections.abc import Sequence

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


def equals_code(
    values: NDArray[np.float64], written: Sequence[tuple[float, float]]
) -> NDArray[np.bool_]:
    """Which readings equal a code in a unit in which they may have been written.

    Args:
        values: readings in SI, any shape.
        written: factors and offsets from SI to these units.
    """
    found = np.zeros(np.shape(values), dtype=bool)
    for factor, offset in written:
        number = values * factor + offset
        whole = np.rint(number)
        code = CODES[np.minimum(np.searchsorted(CODES, whole), len(CODES) - 1)]
        found |= (whole == code) & (np.abs(number - whole) <= EXACT * np.abs(code))
    return found
