"""Radau's points: nodes of the quadrature of order 2 s - 1 that has the end among them."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import Legendre

from .._records import REAL, WHOLE, Record, layout, new_record

MOST = 5  # points

# The points, and the polynomial through values at them. What is beyond `count` is zero.
NODES = layout(
    count=WHOLE,
    abscissa=(REAL, (MOST,)),  # in (0, 1], the last of which is 1
    coefficient=(REAL, (MOST, MOST)),  # of the powers of t (rows) from the values (columns)
    smallest=REAL,  # bound on the product of the distances of any t to all points
)


def radau(points: int) -> Record:
    """A NODES of so many points, at most MOST."""
    shape = Legendre.basis(points) - Legendre.basis(points - 1)
    abscissa = np.sort(0.5 * (1.0 + shape.roots().real))
    coefficient = np.linalg.inv(np.vander(abscissa, increasing=True))
    t = np.linspace(0.0, 1.0, 1001)
    smallest = np.abs(np.prod(t[:, None] - abscissa, axis=1)).max()
    return new_record(
        NODES, count=points, abscissa=abscissa, coefficient=coefficient, smallest=smallest
    )
