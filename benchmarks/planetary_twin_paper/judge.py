"""Comparison of computed values with statements of the paper."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

LEAST_CHANGE = 1e-3  # relative, over a whole range; less is not visible in a plot


def rises(values: ArrayLike, axis: int = -1) -> bool:
    """Whether values increase at every step, and in total by at least `LEAST_CHANGE`.

    Args:
        values: any shape.
        axis: along which to compare.
    """
    array = np.moveaxis(np.asarray(values, dtype=float), axis, -1)
    steps = np.diff(array, axis=-1)
    growth = array[..., -1] - array[..., 0]
    return bool((steps > 0.0).all() and (growth >= LEAST_CHANGE * np.abs(array[..., 0])).all())


def falls(values: ArrayLike, axis: int = -1) -> bool:
    """Whether values decrease at every step, and in total by at least `LEAST_CHANGE`.

    Args:
        values: any shape.
        axis: along which to compare.
    """
    return rises(-np.asarray(values, dtype=float), axis)


def agrees(values: ArrayLike, stated: ArrayLike, relative: float = 1e-9) -> bool:
    """Whether all values agree with stated ones.

    Args:
        values: any shape.
        stated: values of the paper, same shape or scalar.
        relative: largest relative difference.
    """
    return bool(np.allclose(values, stated, rtol=relative, atol=0.0))


def percent(values: ArrayLike, axis: int = -1) -> float:
    """Change of largest magnitude from the first to the last value, relative to the first [%].

    Args:
        values: any shape.
        axis: along which to compare.
    """
    array = np.moveaxis(np.asarray(values, dtype=float), axis, -1)
    change = (array[..., -1] - array[..., 0]) / np.abs(array[..., 0])
    return float(100.0 * change.flat[np.abs(change).argmax()])
