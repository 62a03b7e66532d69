"""Products of a small matrix and vectors, in vector registers.

out[i] = sum over m of rows[m, i] weights[m], for all i there is room for: the weights are read
first, so that the compiler sees one loop over i with nothing to sum inside. Rows beyond those in
use are zero.
"""

from __future__ import annotations

import numpy as np

from ._compile import law
from ._records import BODIES

BLOCK = 8  # rows added up at a time
LANES = BODIES  # known to the compiler, which would not use registers for what may be few


@law
def combine(rows: np.ndarray, weights: np.ndarray, count: int, out: np.ndarray) -> None:
    """Fill out (LANES,) from rows (`count`, LANES) and weights (`count`,)."""
    a, b, c, d = weights[0], weights[1], weights[2], weights[3]
    e, f, g, h = weights[4], weights[5], weights[6], weights[7]
    for i in range(LANES):
        low = rows[0, i] * a + rows[1, i] * b + rows[2, i] * c + rows[3, i] * d
        out[i] = low + rows[4, i] * e + rows[5, i] * f + rows[6, i] * g + rows[7, i] * h
    if count > BLOCK:
        a, b, c, d = weights[8], weights[9], weights[10], weights[11]
        e, f, g, h = weights[12], weights[13], weights[14], weights[15]
        for i in range(LANES):
            low = rows[8, i] * a + rows[9, i] * b + rows[10, i] * c + rows[11, i] * d
            high = rows[12, i] * e + rows[13, i] * f + rows[14, i] * g + rows[15, i] * h
            out[i] += low + high


@law
def combine_both(
    rows: np.ndarray,
    first: np.ndarray,
    second: np.ndarray,
    count: int,
    out_first: np.ndarray,
    out_second: np.ndarray,
) -> None:
    """The same for two vectors at once, which takes hardly longer than for one."""
    a, b, c, d = first[0], first[1], first[2], first[3]
    e, f, g, h = first[4], first[5], first[6], first[7]
    o, p, q, r = second[0], second[1], second[2], second[3]
    s, t, u, v = second[4], second[5], second[6], second[7]
    for i in range(LANES):
        low = rows[0, i] * a + rows[1, i] * b + rows[2, i] * c + rows[3, i] * d
        out_first[i] = low + rows[4, i] * e + rows[5, i] * f + rows[6, i] * g + rows[7, i] * h
        low = rows[0, i] * o + rows[1, i] * p + rows[2, i] * q + rows[3, i] * r
        out_second[i] = low + rows[4, i] * s + rows[5, i] * t + rows[6, i] * u + rows[7, i] * v
    if count > BLOCK:
        a, b, c, d = first[8], first[9], first[10], first[11]
        e, f, g, h = first[12], first[13], first[14], first[15]
        o, p, q, r = second[8], second[9], second[10], second[11]
        s, t, u, v = second[12], second[13], second[14], second[15]
        for i in range(LANES):
            low = rows[8, i] * a + rows[9, i] * b + rows[10, i] * c + rows[11, i] * d
            high = rows[12, i] * e + rows[13, i] * f + rows[14, i] * g + rows[15, i] * h
            out_first[i] += low + high
            low = rows[8, i] * o + rows[9, i] * p + rows[10, i] * q + rows[11, i] * r
            high = rows[12, i] * s + rows[13, i] * t + rows[14, i] * u + rows[15, i] * v
            out_second[i] += low + high
