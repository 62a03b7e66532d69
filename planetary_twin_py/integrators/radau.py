"""Radau's points: nodes of the quadrature of order 2 s - 1 that has the end among them."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import Legendre


def radau(points: int) -> np.ndarray:
    """Abscissae in (0, 1], the last of which is 1."""
    shape = Legendre.basis(points) - Legendre.basis(points - 1)
    return np.sort(0.5 * (1.0 + shape.roots().real))
