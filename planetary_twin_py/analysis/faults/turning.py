"""How often members turn and teeth mesh, in exact fractions of a reference turn."""

from __future__ import annotations

import cmath
import math
from fractions import Fraction
from typing import NamedTuple

from ...gearset.kinematics import Teeth
from ...gearset.phasing import least_mesh_angle
from ...model.layout import Layout
from ...scene import Scene

MOST_PARTS = 10_000  # denominator of the ratio of the two speeds of a differential


class Turning(NamedTuple):
    """Speeds of a gear set, in turns per turn of `reference`."""

    teeth: Teeth
    planets: int
    symmetry: int
    """Order of the rotational symmetry of the planets; their number if equally spaced."""
    places: tuple[float, ...]
    """Angles of the planets on the carrier [rad]."""
    reference: str
    """The carrier, or the sun if the carrier is held."""
    held: str
    """Member at rest, or "none"."""
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

    def added(self, number: int) -> complex:
        """How waves of a number per turn add up over the planets: 1 if all are in phase."""
        return sum(cmath.exp(-1j * number * place) for place in self.places) / self.planets

    def tooth(self, gear: str) -> Fraction:
        """Meshes of one tooth with one mate per turn: turns relative to the carrier.

        Args:
            gear: "sun", "planet" or "ring".
        """
        return self.mesh / getattr(self.teeth, gear)

    @property
    def per_carrier_turn(self) -> int:
        """Teeth that pass a mesh per turn of the carrier, if it turns and a member is held."""
        return int(self.mesh / abs(self.carrier))


def turning_of(scene: Scene) -> Turning:
    """Speeds of the members of a scene (Willis 1841).

    Args:
        scene: of the gearbox; of a differential, at the ratio of its speeds at the operating point,
            as a fraction with a denominator of at most 10 000.

    Raises:
        ValueError: no tooth meshes at the speeds of a differential.
    """
    layout, gearset = Layout(scene), scene.gearset
    base, shares = _inputs(scene)
    speeds = {
        body: sum((x * y for x, y in zip(shares, layout.ratios[body], strict=True)), Fraction(0))
        for body in ("sun", "planet", "ring", "carrier")
    }
    if speeds["sun"] == speeds["carrier"]:
        raise ValueError(
            "operating_point.second_input_speed: sun and carrier turn together, and no tooth meshes"
        )
    reference = "carrier" if speeds["carrier"] else "sun"
    per_turn = {body: speed / speeds[reference] for body, speed in speeds.items()}
    actual = abs(float(speeds[reference]) * base) / math.tau
    return Turning(
        gearset.tooth_numbers,
        gearset.planets,
        _symmetry(gearset.tooth_numbers, gearset.planet_angles),
        gearset.planet_angles,
        reference,
        gearset.held,
        per_turn["sun"],
        per_turn["planet"],
        per_turn["ring"],
        per_turn["carrier"],
        actual,
    )


def _inputs(scene: Scene) -> tuple[float, tuple[Fraction, ...]]:
    """Speed of an input [rad/s], and those of all inputs over it."""
    point = scene.operating_point
    if scene.drive.second_input is None:
        return point.input_speed, (Fraction(1),)
    both = point.input_speed, point.second_input_speed
    base = max(both, key=abs)
    return base, tuple(Fraction(one / (base or 1.0)).limit_denominator(MOST_PARTS) for one in both)


def _symmetry(teeth: Teeth, angles: tuple[float, ...]) -> int:
    """Largest K for which a turn by 1/K leaves the places of all planets as they are."""
    whole, step = teeth.sun + teeth.ring, least_mesh_angle(teeth)
    places = {round((angle - angles[0]) / step) % whole for angle in angles}
    return max(
        parts
        for parts in range(1, len(angles) + 1)
        if whole % parts == 0 and {(place + whole // parts) % whole for place in places} == places
    )
