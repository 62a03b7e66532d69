"""Campbell diagram: speeds at which mesh harmonics coincide with natural frequencies."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..dynamics.bodies import rigid_speeds
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


class MeshLine(NamedTuple):
    """Mesh frequency along the speed of the first motor, the second one at the speed of the scene.

    Frequencies are negative where the sun turns backwards on the carrier.
    """

    slope: float
    """Mesh frequency per speed of the first motor [Hz s/rad]."""
    start: float
    """Mesh frequency while the first motor stands still [Hz]; 0 unless a second one turns."""

    def at(self, speed: np.ndarray) -> np.ndarray:
        """Magnitude of the mesh frequency [Hz] at speeds of the first motor [rad/s].

        Args:
            speed: speeds, (points,).
        """
        return np.abs(self.slope * speed + self.start)

    def speed(self, frequency: float) -> float:
        """Speed of the first motor [rad/s] at a mesh frequency.

        Args:
            frequency: mesh frequency with its sign [Hz].
        """
        return (frequency - self.start) / self.slope

    def lowest_speed(self, highest: float) -> float:
        """Start of the range of speeds that ends at `highest` [rad/s].

        It is 0, as a train turns backwards at the same mesh frequency; not so past a second motor.

        Args:
            highest: highest speed of the first motor [rad/s].
        """
        return -highest if self.start else 0.0


def mesh_line(scene: Scene) -> MeshLine:
    """Mesh frequency along the speed of the first motor.

    Args:
        scene: gives tooth numbers, the member at rest, and the speed of a second motor.
    """
    second = scene.operating_point.second_input_speed
    return MeshLine(*(_passing(scene, inputs) for inputs in ((1.0, 0.0), (0.0, second))))


def mesh_frequency_per_speed(scene: Scene) -> float:
    """Mesh frequency [Hz] per speed of the first motor [rad/s], with the second motor at rest.

    Args:
        scene: gives the tooth numbers and the member at rest.
    """
    return abs(mesh_line(scene).slope)


def _passing(scene: Scene, inputs: tuple[float, float]) -> float:
    """Teeth of the sun that pass the carrier [1/s] at speeds of the motors [rad/s], signed."""
    speeds = rigid_speeds(scene, inputs)
    return scene.gearset.teeth.sun * (speeds["sun"] - speeds["carrier"]) / (2.0 * np.pi)


def resonances(
    scene: Scene,
    modes: NaturalModes,
    springs: SpringModel,
    highest_speed: float,
    harmonics: int = HARMONICS,
    input_speed: float | None = None,
) -> tuple[Resonance, ...]:
    """Resonances up to a speed.

    Args:
        scene: gives the mesh frequency and the mesh phases.
        modes: modes of the scene; a run resonates at the modes for the mean mesh stiffness.
        springs: springs of these modes.
        highest_speed: highest speed of the first motor [rad/s].
        harmonics: number of mesh harmonics.
        input_speed: speed of the first motor at which `modes` are computed [rad/s]; None: at rest.

    Returns:
        The resonances in ascending order of speed. Past a second motor that turns, they begin at
        -`highest_speed`; otherwise speeds of both senses have the same ones, and one is listed.
    """
    line = mesh_line(scene)
    lowest = line.lowest_speed(highest_speed)
    turned = not line.start and (input_speed or 0.0) < 0.0  # the listed speeds are backward ones
    found = []
    for cluster in clusters(modes.frequencies):
        m, frequency = cluster.start, float(modes.frequencies[cluster.start])
        for h in range(1, harmonics + 1):
            for sense in (1.0, -1.0) if frequency else ():
                speed = line.speed(sense * frequency / h)
                if not lowest <= speed <= highest_speed:
                    continue
                backward = (sense < 0.0) != turned
                felt = excitation(scene, springs, modes.shapes[:, cluster], h, backward)
                count = cluster.stop - m
                found.append(Resonance(m, count, modes.kinds[m], frequency, h, speed, felt))
    return tuple(sorted(found, key=lambda r: (r.speed, r.mode)))
