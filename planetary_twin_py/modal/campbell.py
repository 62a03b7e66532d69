"""Campbell diagram: speeds at which mesh harmonics coincide with natural frequencies."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..model.layout import Layout
from ..scene import Scene
from .excitation import EXCITED, excitation
from .forcing import forcing
from .modes import NaturalModes, clusters
from .springs import SpringModel

HARMONICS = 5  # of which all crossings are listed
MOST_HARMONICS = 64
LEAST_SHARE = 0.1  # of the strongest crossing, for which one of a higher harmonic is listed


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
    weight: float = 0.0
    """Vibration of the mesh that moves most [m] under the force of the harmonic on the mode at the
    torque of the scene, if the mode followed without inertia, see `Forcing.answer`; 0 if it is not
    excited. In resonance it is larger by 1/(2 damping ratio)."""


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


def shaft_orders(scene: Scene) -> dict[str, MeshLine]:
    """Frequencies of the shafts along the speed of the first motor, by what they are.

    Unbalance and misalignment excite once a turn; errors of planets, each time that one passes.

    Args:
        scene: gives the members of motor and load, the number of planets, and the second motor.
    """
    second = scene.operating_point.second_input_speed
    ends = [Layout(scene).speeds(*inputs) for inputs in ((1.0, 0.0), (0.0, second))]
    turns = {
        "turn of the input shaft": (scene.drive.input.member, 1),
        "turn of the output shaft": (scene.drive.output.member, 1),
        "planet that passes": ("carrier", scene.gearset.planets),
    }
    return {
        name: MeshLine(*(count * speeds[member] / (2.0 * np.pi) for speeds in ends))
        for name, (member, count) in turns.items()
        if any(speeds[member] for speeds in ends)
    }


def _passing(scene: Scene, inputs: tuple[float, float]) -> float:
    """Teeth of the sun that pass the carrier [1/s] at speeds of the motors [rad/s], signed."""
    speeds = Layout(scene).speeds(*inputs)
    return scene.gearset.teeth.sun * (speeds["sun"] - speeds["carrier"]) / (2.0 * np.pi)


def resonances(
    scene: Scene,
    modes: NaturalModes,
    springs: SpringModel,
    highest_speed: float,
    harmonics: int | None = None,
    input_speed: float | None = None,
) -> tuple[Resonance, ...]:
    """Resonances up to a speed.

    Args:
        scene: gives the mesh frequency, the mesh phases, and the forces at its torque.
        modes: modes of the scene; a run resonates at the modes for the mean mesh stiffness.
        springs: springs of these modes.
        highest_speed: highest speed of the first motor [rad/s].
        harmonics: number of mesh harmonics, of which all crossings are listed; None: all of the
            first five, and those up to the 64th that reach a tenth of the strongest crossing.
        input_speed: speed of the first motor at which `modes` are computed [rad/s]; None: at rest.

    Returns:
        The resonances in ascending order of speed. Past a second motor that turns, they begin at
        -`highest_speed`; otherwise speeds of both senses have the same ones, and one is listed.
    """
    pulled = forcing(scene, springs, harmonics or MOST_HARMONICS)
    line = mesh_line(scene)
    lowest = line.lowest_speed(highest_speed)
    turned = not line.start and (input_speed or 0.0) < 0.0  # the listed speeds are backward ones
    found = []
    for cluster in clusters(modes.frequencies):
        m, frequency = cluster.start, float(modes.frequencies[cluster.start])
        shapes, count = modes.shapes[:, cluster], cluster.stop - cluster.start
        for sense in (1.0, -1.0) if frequency else ():
            backward = (sense < 0.0) != turned
            answer = (pulled.backward if backward else pulled).answer(shapes, frequency)
            for h, (felt, reach) in enumerate(zip(*answer, strict=True), 1):
                speed = line.speed(sense * frequency / h)
                if lowest <= speed <= highest_speed:
                    state = excitation(scene, springs, shapes, h, backward)
                    weight = float(felt) if state == EXCITED else 0.0
                    crossing = Resonance(
                        m, count, modes.kinds[m], frequency, h, speed, state, weight
                    )
                    found.append((crossing, float(reach)))
    listed = [c for c, _ in found] if harmonics is not None else _strong(found)
    return tuple(sorted(listed, key=lambda r: (r.speed, r.mode)))


def _strong(found: list[tuple[Resonance, float]]) -> list[Resonance]:
    """Low harmonics, and a share of the strongest; what is not excited, by what it would reach."""
    felt = LEAST_SHARE * max((crossing.weight for crossing, _ in found), default=0.0)
    others = LEAST_SHARE * max((reach for _, reach in found), default=0.0)
    return [
        crossing
        for crossing, reach in found
        if crossing.harmonic <= HARMONICS
        or (0.0 < crossing.weight >= felt if crossing.excitation == EXCITED else reach > others)
    ]
