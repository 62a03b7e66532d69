"""How computed numbers are compared with what the paper states."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

LEAST_CHANGE = 1e-3  # over a whole range; a smaller one could not be seen in a plot


def rises(values: ArrayLike, axis: int = -1) -> bool:
    """Whether `values` grow at every step along `axis`, visibly from the first to the last."""
    array = np.moveaxis(np.asarray(values, dtype=float), axis, -1)
    steps = np.diff(array, axis=-1)
    growth = array[..., -1] - array[..., 0]
    return bool((steps > 0.0).all() and (growth >= LEAST_CHANGE * np.abs(array[..., 0])).all())


def falls(values: ArrayLike, axis: int = -1) -> bool:
    """Whether `values` fall at every step along `axis`, visibly from the first to the last."""
    return rises(-np.asarray(values, dtype=float), axis)


def agrees(values: ArrayLike, stated: ArrayLike, relative: float = 1e-9) -> bool:
    """Whether all `values` are what is `stated`, but for a relative difference."""
    return bool(np.allclose(values, stated, rtol=relative, atol=0.0))


def percent(values: ArrayLike, axis: int = -1) -> float:
    """Largest change from first to last along `axis`, in percent of the first."""
    array = np.moveaxis(np.asarray(values, dtype=float), axis, -1)
    change = (array[..., -1] - array[..., 0]) / np.abs(array[..., 0])
    return float(100.0 * change.flat[np.abs(change).argmax()])
