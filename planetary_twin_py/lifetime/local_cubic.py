"""Interpolation between the nodes of an axis, from the nearest four of them.

A table whose nodes are computed when they are needed has no spline through all of them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
NEAREST = 4


class Stencil(NamedTuple):
    """Nodes that values between them are interpolated from, and their weights."""

    nodes: NDArray[np.int64]
    """Places on the axis, (n, size)."""
    weights: Array
    """Of the cubic through them (Lagrange), (n, size)."""
    linear: Array
    """Of the straight line through the two next to the value, (n, size)."""


def stencil(axis: Array, value: Array) -> Stencil:
    """The stencil of values on an axis; beyond its ends the line through the last two nodes.

    Args:
        axis: ascending nodes, (nodes,).
        value: (n,).

    Returns:
        Of the four nodes, or of all of a shorter axis.
    """
    size, last = min(NEAREST, len(axis)), len(axis) - 1
    below = np.clip(np.searchsorted(axis, value, "right") - 1, 0, max(last - 1, 0))
    first = np.clip(below - (size // 2 - 1), 0, len(axis) - size) if size > 1 else below
    nodes = first[:, np.newaxis] + np.arange(size)
    places = axis[nodes]
    linear = _line(places, below - first, value)
    inside = (value >= axis[0]) & (value <= axis[-1])
    return Stencil(nodes, np.where(inside[:, np.newaxis], _cubic(places, value), linear), linear)


def _cubic(places: Array, value: Array) -> Array:
    weights = np.ones(places.shape)
    for k in range(places.shape[1]):
        for other in range(places.shape[1]):
            if other != k:
                weights[:, k] *= (value - places[:, other]) / (places[:, k] - places[:, other])
    return weights


def _line(places: Array, below: NDArray[np.int64], value: Array) -> Array:
    weights, rows = np.zeros(places.shape), np.arange(len(places))
    if places.shape[1] == 1:
        return np.ones(places.shape)
    low, high = places[rows, below], places[rows, below + 1]
    share = (value - low) / (high - low)
    weights[rows, below], weights[rows, below + 1] = 1.0 - share, share
    return weights
