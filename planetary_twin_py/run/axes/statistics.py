"""Statistics of the motion of axes over a run."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class AxesStatistics(NamedTuple):
    """Statistics of all axes over a run, with the directions of `AxesMotion`.

    A load that stands still in the housing, such as weight, turns in the frame of the carrier, so
    it is not part of the mean vectors of sun, ring and carrier, but of the mean magnitudes.
    """

    displacement_mean: np.ndarray
    """Mean displacement [m], (bodies, 2)."""
    displacement_peak: np.ndarray
    """Largest displacement [m], (bodies,)."""
    bearing_force_mean: np.ndarray
    """Mean force on the bearing [N], (bodies, 2)."""
    bearing_force_peak: np.ndarray
    """Largest force on the bearing [N], (bodies,)."""
    tilting: TiltingStatistics | None
    """Statistics of axial motion and tilts; None where axes do not tilt."""
    displacement_magnitude: np.ndarray
    """Mean magnitude of the displacement [m], (bodies,)."""
    bearing_force_magnitude: np.ndarray
    """Mean magnitude of the force on the bearing [N], (bodies,)."""
    largest_load_share: np.ndarray | None
    """Largest share of each planet, of means over a mesh cycle, (planets,); None before a cycle is
    complete."""


class TiltingStatistics(NamedTuple):
    """Statistics of axial motion and tilts over a run."""

    axial_displacement_mean: np.ndarray
    """Mean axial displacement [m], (bodies,)."""
    tilt_mean: np.ndarray
    """Mean tilt about two directions [rad], (bodies, 2)."""
    axial_force_mean: np.ndarray
    """Mean thrust on the bearing [N], (bodies,)."""
    axial_force_peak: np.ndarray
    """Largest thrust on the bearing [N], (bodies,)."""
    tilting_moment_mean: np.ndarray
    """Mean moment on the bearing about two directions [N m], (bodies, 2)."""
    tilting_moment_peak: np.ndarray
    """Largest moment on the bearing [N m], (bodies,)."""
    tilt_magnitude: np.ndarray
    """Mean magnitude of the tilt [rad], (bodies,)."""
    tilting_moment_magnitude: np.ndarray
    """Mean magnitude of the moment on the bearing [N m], (bodies,)."""
