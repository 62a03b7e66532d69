"""Campbell diagram: where the meshing frequency and its harmonics meet natural frequencies."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..dynamics.bodies import rigid_ratios
from ..gearset.kinematics import mesh_cycles_per_turn
from ..scene import Scene
from .modes import NaturalModes, clusters

HARMONICS = 5


class Resonance(NamedTuple):
    """A speed of the first motor at which a harmonic of the meshing frequency meets a mode."""

    mode: int  # place in the order of frequencies, from 0; of modes of one frequency, the first
    multiplicity: int  # number of modes of this frequency
    kind: str
    frequency: float  # [Hz]
    harmonic: int
    speed: float  # [rad/s]


def mesh_frequency_per_speed(scene: Scene) -> float:
    """Meshing frequency [Hz] per speed of the first motor [rad/s], a second one being at rest."""
    ratios = {kind: ratio[0] for kind, ratio in rigid_ratios(scene).items()}
    cycles = mesh_cycles_per_turn(scene.gearset.tooth_numbers, ratios)
    return abs(float(cycles)) / (2.0 * np.pi)


def resonances(
    scene: Scene, modes: NaturalModes, highest_speed: float, harmonics: int = HARMONICS
) -> tuple[Resonance, ...]:
    """All of them up to `highest_speed` [rad/s], in the order of speed.

    Modes at mean mesh stiffness are those at which a run resonates.
    """
    per_speed = mesh_frequency_per_speed(scene)
    levels = [(c.start, c.stop - c.start) for c in clusters(modes.frequencies)]
    found = [
        Resonance(m, count, modes.kinds[m], frequency, h, frequency / (h * per_speed))
        for m, count in levels
        for h in range(1, harmonics + 1)
        if (frequency := float(modes.frequencies[m])) > 0.0
    ]
    return tuple(
        sorted((r for r in found if r.speed <= highest_speed), key=lambda r: (r.speed, r.mode))
    )
