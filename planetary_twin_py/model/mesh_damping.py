"""Damping c = tau k of the two kinds of mesh, and the natural frequency of each mesh alone.

Arrays of length 2 hold the sun-planet mesh at 0 and the planet-ring mesh at 1.
"""

from __future__ import annotations

import math

import numpy as np

from ..gearset.kinematics import mesh_cycles_per_turn
from ..scene import Scene
from .bodies import rigid_ratios, rim_masses
from .stiffness_laws import GEARS


def natural_frequencies(scene: Scene, stiffness: np.ndarray) -> np.ndarray:
    """Natural frequency [rad/s] (2,) of a mesh of this `stiffness` [N/m] between two free gears.

    sqrt(k (1/ma + 1/mb)) with J/r_b^2 of both (Kahraman and Singh 1990, J. Sound Vib. 142).
    """
    mass = rim_masses(scene)
    effective = np.array([mass[a] * mass[b] / (mass[a] + mass[b]) for a, b in GEARS])
    return np.asarray(np.sqrt(stiffness / effective))


def steady_damping_times(scene: Scene, stiffness: np.ndarray) -> np.ndarray:
    """tau [s] (2,) if it is independent of speed, else 0; `stiffness` [N/m] is that of one pair."""
    damping = scene.mesh.damping
    natural = natural_frequencies(scene, stiffness)
    if damping.law == "viscous":
        return 2.0 * damping.damping_ratio / natural
    if damping.law == "natural_frequency":
        return damping.loss_factor * 2.0 * math.pi / natural
    return np.zeros(2)


def damping_cycles(scene: Scene) -> float:
    """tau times meshing frequency [-] if the damping depends on speed, else 0."""
    damping, teeth = scene.mesh.damping, scene.gearset.tooth_numbers
    if not damping.follows_speed:
        return 0.0
    if damping.law == "meshing_frequency":
        return damping.loss_factor
    # (1e) uses Zs Zr/(Zs + Zr) cycles per turn of the input for any held member.
    printed = teeth.sun * teeth.ring / (teeth.sun + teeth.ring)
    ratios = {kind: ratio[0] for kind, ratio in rigid_ratios(scene).items()}
    return damping.loss_factor * abs(float(mesh_cycles_per_turn(teeth, ratios))) / printed
