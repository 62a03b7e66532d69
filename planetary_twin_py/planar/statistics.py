"""Means and largest values of the motion of axes over a time interval."""

from __future__ import annotations

import math

import numpy as np

from .. import _core
from .motion import AxesMotion


def axes_statistics(motion: AxesMotion) -> dict[str, np.ndarray]:
    """Statistics of the samples of axes that move.

    Args:
        motion: motion of the axes in a run or a window; without samples all values are NaN.

    Returns:
        By the names of `quantities.BEARING`: mean vectors (bodies, 2) and largest magnitudes
        (bodies,); "orbit", the last sample (3, 2) [m]; by the names of `quantities.FLANKS`, mean
        forces (meshes,) [N].
    """
    if not len(motion.orbit):
        nothing = np.full((1, *motion.flank_force.shape[1:]), math.nan)
        moved = np.full((1, len(motion.bodies), 2), math.nan)
        motion = AxesMotion(
            motion.bodies, moved, moved, moved[:, :3], nothing, motion.mean_load_share
        )
    drive, coast = _mean(motion.flank_force)
    return {
        "displacement": _mean(motion.displacement),
        "displacement_peak": _largest_magnitude(motion.displacement),
        "bearing_force": _mean(motion.bearing_force),
        "bearing_force_peak": _largest_magnitude(motion.bearing_force),
        "orbit": motion.orbit[-1],
        "drive_force": drive,
        "coast_force": coast,
    }


# By the core, in a quarter of NumPy's time: a live twin computes them for every window.


def _mean(values: np.ndarray) -> np.ndarray:
    """Mean over the samples, (samples, n, m) to (n, m)."""
    mean = np.empty(values.shape[1:])
    _core.column_means(values.reshape(len(values), -1), mean.reshape(-1))
    return mean


def _largest_magnitude(vectors: np.ndarray) -> np.ndarray:
    """Largest magnitude over the samples, (samples, n, 2) to (n,)."""
    largest = np.empty(vectors.shape[1])
    _core.largest_magnitudes(vectors.reshape(len(vectors), -1), largest)
    return largest
