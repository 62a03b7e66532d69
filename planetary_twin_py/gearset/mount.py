"""Orientation of the gears in the assembly position, in which their teeth mesh.

Convention: all angles are zero in the assembly position. There the leading (counter-clockwise)
flank of tooth 0 of the sun contacts planet 1 at the pitch point; mesh phases are counted from
there. The teeth of planet i are in gaps of the sun, and the teeth of the ring are in gaps of planet
1. They are also in gaps of the other planets, because the set can be assembled. The orientation of
a gear is its mount angle plus its absolute angle; rolling keeps the teeth in mesh.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from .kinematics import Teeth

_TURN = 2.0 * math.pi


class Mount(NamedTuple):
    """Direction of tooth 0 of sun, planets and ring in the assembly position [rad]."""

    sun: float
    planets: tuple[float, ...]
    ring: float


class Mate(NamedTuple):
    """The other gear of a mesh."""

    teeth: int
    """Number of teeth."""
    angle: float
    """Of its tooth 0 [rad]."""
    direction: float
    """Of the mesh from its centre [rad]."""


def mount_angle(teeth: int, direction: float, mate: Mate, internal: bool = False) -> float:
    """Angle of tooth 0 of a gear at which its gaps coincide with teeth of the mating gear [rad].

    Args:
        teeth: number of teeth.
        direction: of the mesh from the centre of the gear [rad].
        mate: the mating gear.
        internal: whether one of the two is an internal gear. The teeth of both then follow each
            other in the same direction along the pitch line, otherwise in opposite directions.
    """
    pitches = mate.teeth * (mate.angle - mate.direction) / _TURN
    return direction + _TURN / teeth * (0.5 + (pitches if internal else -pitches))


def mount(teeth: Teeth, planet_angles: Sequence[float], lead: float = 0.5) -> Mount:
    """Mount angles of sun, planets and ring.

    Args:
        teeth: tooth numbers.
        planet_angles: positions of the planets [rad].
        lead: `WorkingMesh.coast_lead` of the sun meshes [cycles].

    Returns:
        Direction of tooth 0 of each gear [rad].
    """
    first = planet_angles[0]
    sun = first - 0.5 * lead * _TURN / teeth.sun
    planets = tuple(
        mount_angle(teeth.planet, psi + math.pi, Mate(teeth.sun, sun, psi)) for psi in planet_angles
    )
    mate = Mate(teeth.planet, planets[0], first)
    return Mount(sun, planets, mount_angle(teeth.ring, first, mate, internal=True))
