"""Polynomials through values at fixed nodes, with the same bits on every machine.

Least squares by LAPACK have other last digits on other processors, and with them all that follows.
"""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise

import numpy as np

from .._core import TERMS

# Chebyshev points of 0 to 1. Rounded, since the cosine has other last digits in other C libraries.
NODES = np.array(
    [round(0.5 - 0.5 * math.cos(math.pi * (k + 0.5) / TERMS), 6) for k in range(TERMS)]
)

DECIMALS = 12  # of coefficients


def _basis(k: int) -> list[float]:
    """Coefficients of the polynomial that is 1 at node k and 0 at the others."""
    nodes = [Fraction(float(node)) for node in NODES]
    product = [Fraction(1)]
    for node in nodes[:k] + nodes[k + 1 :]:
        shifted = [Fraction(0), *product, Fraction(0)]
        product = [(low - node * high) / (nodes[k] - node) for low, high in pairwise(shifted)]
    return [float(each) for each in product]


_BASIS = np.array([_basis(k) for k in range(TERMS)])


def through(values: np.ndarray) -> np.ndarray:
    """Coefficients of the polynomial through values at `NODES`, lowest first.

    Args:
        values: at the nodes, of the order of one, (..., TERMS).

    Returns:
        Coefficients without rounding errors: a constant has one coefficient, (..., TERMS).
    """
    coefficients = np.zeros(values.shape)
    for k, basis in enumerate(_BASIS):  # in order: a matrix product has none
        coefficients += values[..., k, None] * basis
    return np.round(coefficients, DECIMALS)
