"""Campbell diagram: speeds at which mesh harmonics coincide with natural frequencies."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..dynamics.bodies import rigid_ratios
from ..gearset.kinematics import mesh_cycles_per_turn
from ..scene import Scene
from .modes import NaturalModes, clusters

HARMONICS = 5


class Resonance(NamedTuple):
    """A speed of the first motor at which a mesh harmonic coincides with a natural frequency."""

    mode: int
    """Index in ascending order of frequency; the first of several modes with the same frequency."""
    multiplicity: int
    """Number of modes with this frequency."""
    kind: str
    """Kind of the mode, see `modes`."""
    frequency: float
    """Natural frequency [Hz]."""
    harmonic: int
    """Number of the mesh harmonic, from 1."""
    speed: float
    """Speed of the first motor [rad/s]."""


def mesh_frequency_per_speed(scene: Scene) -> float:
    """Mesh frequency [Hz] per speed of the first motor [rad/s], with the second motor at rest.

    Args:
        scene: gives the tooth numbers and the member at rest.
    """
    ratios = {kind: ratio[0] for kind, ratio in rigid_ratios(scene).items()}
    cycles = mesh_cycles_per_turn(scene.gearset.tooth_numbers, ratios)
    return abs(float(cycles)) / (2.0 * np.pi)


def resonances(
    scene: Scene, modes: NaturalModes, highest_speed: float, harmonics: int = HARMONICS
) -> tuple[Resonance, ...]:
    """Resonances up to a speed.

    Args:
        scene: gives the mesh frequency.
        modes: modes of the scene; a run resonates at the modes for the mean mesh stiffness.
        highest_speed: highest speed of the first motor [rad/s].
        harmonics: number of mesh harmonics.

    Returns:
        The resonances in ascending order of speed.
    """
    per_speed = mesh_frequency_per_speed(scene)
    levels = [(c.start, c.stop - c.start) for c in clusters(modes.frequencies)]
    candidates = [
        Resonance(m, count, modes.kinds[m], frequency, h, frequency / (h * per_speed))
        for m, count in levels
        for h in range(1, harmonics + 1)
        if (frequency := float(modes.frequencies[m])) > 0.0
    ]
    return tuple(
        sorted((r for r in candidates if r.speed <= highest_speed), key=lambda r: (r.speed, r.mode))
    )
