"""How often members turn and teeth mesh, in exact fractions of a reference turn."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

from ..gearset.kinematics import Teeth
from ..gearset.phasing import least_mesh_angle
from ..model.layout import Layout
from ..scene import Scene


class Turning(NamedTuple):
    """Speeds of a gear set with one input, in turns per turn of `reference`."""

    teeth: Teeth
    planets: int
    alike: int
    """Number of equal parts into which the planets divide a turn; theirs if equally spaced."""
    reference: str
    """The carrier, or the sun if the carrier is held."""
    held: str
    sun: Fraction
    """Absolute speeds, positive in the sense of the reference."""
    planet: Fraction
    ring: Fraction
    carrier: Fraction
    reference_speed: float
    """Of the reference at the operating point, magnitude [turns/s]."""

    @property
    def mesh(self) -> Fraction:
        """Mesh cycles per turn."""
        return self.teeth.sun * abs(self.sun - self.carrier)

    def tooth(self, gear: str) -> Fraction:
        """Meshes of one tooth with one mate per turn: turns relative to the carrier.

        Args:
            gear: "sun", "planet" or "ring".
        """
        return self.mesh / getattr(self.teeth, gear)

    @property
    def per_carrier_turn(self) -> int:
        """Teeth that pass a mesh per turn of the carrier, which turns."""
        return int(self.mesh / abs(self.carrier))


def turning_of(scene: Scene) -> Turning:
    """Speeds of the members of a scene (Willis 1841).

    Args:
        scene: of the gearbox.

    Raises:
        ValueError: the scene has two inputs, whose speeds may have any ratio.
    """
    layout, gearset = Layout(scene), scene.gearset
    if scene.drive.second_input is not None:
        raise ValueError(
            "drive.second_input: must be none: the orders of a differential change with the ratio "
            "of its two speeds"
        )
    speeds = {body: layout.ratios[body][0] for body in ("sun", "planet", "ring", "carrier")}
    reference = "carrier" if speeds["carrier"] else "sun"
    per_turn = {body: speed / speeds[reference] for body, speed in speeds.items()}
    actual = abs(float(speeds[reference]) * scene.operating_point.input_speed) / math.tau
    return Turning(
        gearset.tooth_numbers,
        gearset.planets,
        _alike(gearset.tooth_numbers, gearset.planet_angles),
        reference,
        gearset.held,
        per_turn["sun"],
        per_turn["planet"],
        per_turn["ring"],
        per_turn["carrier"],
        actual,
    )


def _alike(teeth: Teeth, angles: tuple[float, ...]) -> int:
    """Largest K for which a turn by 1/K leaves the places of all planets as they are."""
    whole, step = teeth.sun + teeth.ring, least_mesh_angle(teeth)
    places = {round((angle - angles[0]) / step) % whole for angle in angles}
    return max(
        parts
        for parts in range(1, len(angles) + 1)
        if whole % parts == 0 and {(place + whole // parts) % whole for place in places} == places
    )
