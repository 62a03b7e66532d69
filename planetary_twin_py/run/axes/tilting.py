"""Results of a run with tilting axes: axial motion, tilts, thrust and moments."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class TiltingMotion(NamedTuple):
    """Axial motion and tilts of the axes in a run, with thrust and moments on the bearings.

    Directions are those of `AxesMotion`: tilts and moments of sun, ring and carrier are about x and
    y in the frame of the carrier, those of planets about the radial and the tangential direction.
    The axial direction is z of a right-handed frame; positive rotations are about it.
    """

    axial_displacement: np.ndarray
    """Displacement of each body along its axis [m], (samples, bodies)."""
    tilt: np.ndarray
    """Tilt of each axis about two directions [rad], (samples, bodies, 2)."""
    axial_force: np.ndarray
    """Thrust of each body on its bearing [N], (samples, bodies)."""
    tilting_moment: np.ndarray
    """Moment of each body on its bearing about two directions [N m], (samples, bodies, 2)."""


def tilting_motion(tilting: np.ndarray) -> TiltingMotion | None:
    """Axial motion and tilts from samples.

    Args:
        tilting: `tilting` of `run.samples.Samples`, (samples, bodies, 6).

    Returns:
        Motion and loads; None if the axes do not tilt.
    """
    if not tilting.shape[2]:
        return None
    return TiltingMotion(tilting[:, :, 0], tilting[:, :, 1:3], tilting[:, :, 3], tilting[:, :, 4:])
