"""Small symmetric positive definite systems, solved in place."""

from __future__ import annotations

import math

import numpy as np

from ._compile import kernel


@kernel
def factorise(a: np.ndarray, n: int) -> None:
    """Cholesky factor of the leading n x n part, in the lower triangle; inverse diagonal."""
    for j in range(n):
        pivot = a[j, j]
        for k in range(j):
            pivot -= a[j, k] * a[j, k]
        inverse = 1.0 / math.sqrt(pivot)
        a[j, j] = inverse
        for i in range(j + 1, n):
            value = a[i, j]
            for k in range(j):
                value -= a[i, k] * a[j, k]
            a[i, j] = value * inverse


@kernel
def solve(a: np.ndarray, n: int, b: np.ndarray) -> None:
    """Let b (n,) hold the solution, from what `factorise` left in `a`."""
    for i in range(n):
        value = b[i]
        for k in range(i):
            value -= a[i, k] * b[k]
        b[i] = value * a[i, i]
    for i in range(n - 1, -1, -1):
        value = b[i]
        for k in range(i + 1, n):
            value -= a[k, i] * b[k]
        b[i] = value * a[i, i]
