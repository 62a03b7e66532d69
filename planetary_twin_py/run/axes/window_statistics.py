"""Means and largest values of the motion of axes over a time interval."""

from __future__ import annotations

import math

import numpy as np

from .motion import AxesMotion


def axes_statistics(motion: AxesMotion) -> dict[str, np.ndarray]:
    """Statistics of the samples of axes that move.

    Args:
        motion: motion of the axes in a run or a window; without samples all values are NaN.

    Returns:
        By the names of `units.catalogue.BEARING`: mean vectors (bodies, 2) and largest magnitudes
        (bodies,); "orbit", the last sample (3, 2) [m]; by the names of `units.catalogue.FLANKS`,
        mean forces (meshes,) [N].
    """
    if not len(motion.orbit):
        nothing = np.full((1, *motion.flank_force.shape[1:]), math.nan)
        moved = np.full((1, len(motion.bodies), 2), math.nan)
        motion = AxesMotion(
            motion.bodies, moved, moved, moved[:, :3], nothing, motion.mean_load_share
        )
    statistics = {}
    for name, vectors in (
        ("displacement", motion.displacement),
        ("bearing_force", motion.bearing_force),
    ):
        statistics[name] = vectors.mean(axis=0)
        x, y = vectors[:, :, 0], vectors[:, :, 1]
        statistics[f"{name}_peak"] = np.sqrt((x * x + y * y).max(axis=0))
    drive, coast = motion.flank_force.mean(axis=0)
    return statistics | {"orbit": motion.orbit[-1], "drive_force": drive, "coast_force": coast}
