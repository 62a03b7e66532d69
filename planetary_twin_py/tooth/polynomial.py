"""Polynomial approximation of a smooth law along the path of contact, for the dynamics."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev, Polynomial
from numpy.typing import NDArray

Floats = NDArray[np.float64]

DEGREE = 4


class Fit(NamedTuple):
    """A polynomial and its error."""

    coefficients: Floats
    """Coefficients of 1, s, s^2, ..., (degree + 1,)."""
    error: float
    """Largest relative error at the points of the fit."""


def fit(law: Callable[[Floats], Floats], low: float, high: float, degree: int = DEGREE) -> Fit:
    """Fit a polynomial in the position s to a law.

    The relative error is minimised in the least-squares sense at Chebyshev points, including both
    ends, which is close to the minimax fit.

    Args:
        law: positive function of the position, (m,) to (m,).
        low: start of the interval.
        high: end of the interval.
        degree: degree of the polynomial.

    Returns:
        Coefficients and largest relative error at these points.
    """
    points = np.cos(np.linspace(0.0, np.pi, 16 * (degree + 1)))
    position = 0.5 * (low + high) + 0.5 * (high - low) * points
    value = law(position)
    series = Chebyshev.fit(position, value, degree, domain=[low, high], w=1.0 / value)
    power = series.convert(kind=Polynomial)
    coefficients = np.zeros(degree + 1)  # keeps leading zeros
    coefficients[: len(power.coef)] = power.coef
    return Fit(coefficients, float(np.max(np.abs(power(position) / value - 1.0))))
