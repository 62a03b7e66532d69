"""How the gears stand to one another at angle zero, so that their teeth mesh.

Convention: angle zero of every body is the assembly position. There, tooth 0 of the sun points
along +x; planet i stands so that its teeth fill the sun's gaps; the ring stands so that its teeth
fill the gaps of planet 1. From then on each gear is drawn at its mount angle plus its own absolute
angle, and rolling keeps the teeth in mesh. A planet fits the ring as well as planet 1 does only if
(sun_teeth + ring_teeth) * (psi_i - psi_1) / 2 pi is whole: `assembly_error` says how far it is off.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from planetary_twin_py.gearset.geometry import GearsetGeometry

_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class Mount:
    """Angle [rad] of tooth 0 of each gear in the assembly position."""

    sun: float
    planets: tuple[float, ...]
    ring: float


def mount_angle(
    teeth: int, direction: float, mate: tuple[int, float, float], internal: bool = False
) -> float:
    """Angle [rad] of a gear's tooth 0 that puts a gap of it where its mate has a tooth.

    `direction` [rad] is where the contact lies as seen from this gear's centre; `mate` is
    (teeth, mount angle [rad], direction [rad]) of the gear it meshes with, the direction seen from
    the mate's own centre. `internal`: one of the two is an internal gear, so that both run along
    the common pitch line in the same sense; two external gears run in opposite senses.
    """
    mate_teeth, mate_angle, mate_direction = mate
    pitches = mate_teeth * (mate_angle - mate_direction) / _TURN
    return direction + _TURN / teeth * (0.5 + (pitches if internal else -pitches))


def mount(geometry: GearsetGeometry) -> Mount:
    """Mount angles of the sun, the planets and the ring in the assembly position."""
    sun = 0.0
    planets = tuple(
        mount_angle(geometry.planet_teeth, psi + math.pi, (geometry.sun_teeth, sun, psi))
        for psi in geometry.planet_angles
    )
    first = geometry.planet_angles[0]
    ring = mount_angle(
        geometry.ring_teeth, first, (geometry.planet_teeth, planets[0], first), internal=True
    )
    return Mount(sun, planets, ring)


def assembly_error(geometry: GearsetGeometry) -> tuple[float, ...]:
    """Offset of each planet's teeth from the ring's gaps [m], along the pitch circle.

    Zero for a set that can be assembled; at most half a pitch.
    """
    first = geometry.planet_angles[0]
    total = geometry.sun_teeth + geometry.ring_teeth
    turns = [total * (psi - first) / _TURN for psi in geometry.planet_angles]
    return tuple((n - round(n)) * math.pi * geometry.module for n in turns)
