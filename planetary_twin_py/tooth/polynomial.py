"""A smooth law along the path of contact as a polynomial, for the dynamics."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev, Polynomial
from numpy.typing import NDArray

Floats = NDArray[np.float64]

DEGREE = 4


class Fit(NamedTuple):
    """`coefficients` (degree + 1,) of 1, s, s^2, ... and the largest relative `error` seen."""

    coefficients: Floats
    error: float


def fit(law: Callable[[Floats], Floats], low: float, high: float, degree: int = DEGREE) -> Fit:
    """Polynomial in the position s that follows the positive `law` from `low` to `high`.

    Least squares at Chebyshev points with the relative error as residual, close to the best
    possible; the error is looked for at the same points and at the ends.
    """
    points = np.cos(np.linspace(0.0, np.pi, 16 * (degree + 1)))
    position = 0.5 * (low + high) + 0.5 * (high - low) * points
    value = law(position)
    series = Chebyshev.fit(position, value, degree, domain=[low, high], w=1.0 / value)
    power = series.convert(kind=Polynomial)
    coefficients = np.zeros(degree + 1)  # a vanishing leading one is not trimmed away
    coefficients[: len(power.coef)] = power.coef
    return Fit(coefficients, float(np.max(np.abs(power(position) / value - 1.0))))
