"""Campbell diagram: speeds at which mesh harmonics coincide with natural frequencies."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..dynamics.bodies import rigid_ratios
from ..gearset.kinematics import mesh_cycles_per_turn
from ..scene import Scene
from .excitation import excitation
from .modes import NaturalModes, clusters
from .springs import SpringModel

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
    excitation: str
    """`EXCITED`, `SUPPRESSED` or `NO_MESH` of `excitation`, for equal planets without errors of
    position and form."""


def mesh_frequency_per_speed(scene: Scene) -> float:
    """Mesh frequency [Hz] per speed of the first motor [rad/s], with the second motor at rest.

    Args:
        scene: gives the tooth numbers and the member at rest.
    """
    return abs(_mesh_cycles(scene)) / (2.0 * np.pi)


def _mesh_cycles(scene: Scene) -> float:
    """Mesh cycles per turn of the first motor, negative if the sun turns back on the carrier."""
    ratios = {kind: ratio[0] for kind, ratio in rigid_ratios(scene).items()}
    return float(mesh_cycles_per_turn(scene.gearset.tooth_numbers, ratios))


def resonances(
    scene: Scene,
    modes: NaturalModes,
    springs: SpringModel,
    highest_speed: float,
    harmonics: int = HARMONICS,
    input_speed: float = 0.0,
) -> tuple[Resonance, ...]:
    """Resonances up to a speed.

    Args:
        scene: gives the mesh frequency and the mesh phases.
        modes: modes of the scene; a run resonates at the modes for the mean mesh stiffness.
        springs: springs of these modes.
        highest_speed: highest speed of the first motor [rad/s].
        harmonics: number of mesh harmonics.
        input_speed: speed of the first motor at which `modes` are computed [rad/s].

    Returns:
        The resonances in ascending order of speed.
    """
    per_speed = mesh_frequency_per_speed(scene)
    backward = input_speed * _mesh_cycles(scene) < 0.0
    found = []
    for cluster in clusters(modes.frequencies):
        m, frequency = cluster.start, float(modes.frequencies[cluster.start])
        for h in range(1, harmonics + 1):
            speed = frequency / (h * per_speed)
            if 0.0 < speed <= highest_speed:
                felt = excitation(scene, springs, modes.shapes[:, cluster], h, backward)
                count = cluster.stop - m
                found.append(Resonance(m, count, modes.kinds[m], frequency, h, speed, felt))
    return tuple(sorted(found, key=lambda r: (r.speed, r.mode)))
