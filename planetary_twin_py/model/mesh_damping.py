"""Damping c = tau k of the two kinds of mesh, and the natural frequency of each mesh alone.

Arrays of length 2 hold the sun-planet mesh at 0 and the planet-ring mesh at 1.
"""

from __future__ import annotations

import math

import numpy as np

from .layout import Layout
from .stiffness_laws import GEARS


def natural_frequencies(layout: Layout, stiffness: np.ndarray) -> np.ndarray:
    """Natural frequency [rad/s] (2,) of a mesh of this `stiffness` [N/m] between two free gears.

    sqrt(k (1/ma + 1/mb)) with J/r_b^2 of both (Kahraman and Singh 1990, J. Sound Vib. 142).
    """
    mass = layout.masses
    effective = np.array([mass[a] * mass[b] / (mass[a] + mass[b]) for a, b in GEARS])
    return np.asarray(np.sqrt(stiffness / effective))


def steady_damping_times(layout: Layout, stiffness: np.ndarray) -> np.ndarray:
    """tau [s] (2,) if it is independent of speed, else 0; `stiffness` [N/m] is that of one pair."""
    damping = layout.scene.mesh.damping
    natural = natural_frequencies(layout, stiffness)
    if damping.law == "viscous":
        return 2.0 * damping.damping_ratio / natural
    if damping.law == "natural_frequency":
        return damping.loss_factor * 2.0 * math.pi / natural
    return np.zeros(2)


def damping_cycles(layout: Layout) -> float:
    """tau times meshing frequency [-] if the damping depends on speed, else 0."""
    damping, teeth = layout.scene.mesh.damping, layout.scene.gearset.tooth_numbers
    if not damping.follows_speed:
        return 0.0
    if damping.law == "meshing_frequency":
        return damping.loss_factor
    # (1e) uses Zs Zr/(Zs + Zr) cycles per turn of the input for any held member.
    printed = teeth.sun * teeth.ring / (teeth.sun + teeth.ring)
    return damping.loss_factor * abs(float(layout.cycles[0])) / printed
