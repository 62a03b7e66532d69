"""How the gears stand to one another at angle zero, so that their teeth mesh.

Convention: angle zero of every body is the assembly position. There the leading
(counter-clockwise) flank of the sun's tooth 0 meets planet 1 at the pitch point, which is where
the mesh phases count from; the teeth of planet i fill the sun's gaps, and the ring's teeth fill
those of planet 1. Each gear stands at its mount angle plus its own absolute angle, and rolling
keeps the teeth in mesh. The other planets fit the ring because the set can be assembled.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from .kinematics import Teeth

_TURN = 2.0 * math.pi


class Mount(NamedTuple):
    """Direction [rad] of tooth 0 of each gear in the assembly position."""

    sun: float
    planets: tuple[float, ...]
    ring: float


class Mate(NamedTuple):
    """A gear seen from its mesh: tooth number, angles [rad] of its tooth 0 and of the mesh."""

    teeth: int
    angle: float
    direction: float


def mount_angle(teeth: int, direction: float, mate: Mate, internal: bool = False) -> float:
    """Angle [rad] of a gear's tooth 0 that puts a gap of it where its mate has a tooth.

    `direction` [rad] is that of the mesh seen from this gear's own centre. `internal`: one of the
    two is an internal gear, so that the teeth of both follow one another in the same sense along
    the pitch line; on two external gears they run in opposite senses.
    """
    pitches = mate.teeth * (mate.angle - mate.direction) / _TURN
    return direction + _TURN / teeth * (0.5 + (pitches if internal else -pitches))


def mount(teeth: Teeth, planet_angles: Sequence[float]) -> Mount:
    """Mount angles of sun, planets and ring for planets at `planet_angles` [rad]."""
    first = planet_angles[0]
    sun = first - 0.25 * _TURN / teeth.sun
    planets = tuple(
        mount_angle(teeth.planet, psi + math.pi, Mate(teeth.sun, sun, psi)) for psi in planet_angles
    )
    mate = Mate(teeth.planet, planets[0], first)
    return Mount(sun, planets, mount_angle(teeth.ring, first, mate, internal=True))
