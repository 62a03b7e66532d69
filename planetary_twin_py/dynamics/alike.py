"""Planets that move alike for ever: one of each group is integrated, and counts for all of it.

Planets start alike and carry alike. What can tell them apart is where their meshes stand in the
cycle, and which teeth are there if teeth differ. Mesh phases are exact fractions, so it is decided
exactly; what else tells real planets apart has to be in the scene. (Planets in phase: Kahraman
1994, Planetary gear train dynamics; Parker and Lin 2004.)
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

from ..gearset.phasing import mesh_phases
from ..scene import Scene

# What a planet shows to its surroundings: phases of both meshes, and its number if that counts.
_Look = tuple[Fraction, Fraction, int | None]


class PlanetGroups(NamedTuple):
    """Groups of planets that move alike."""

    leaders: tuple[int, ...]  # of each group the planet that is integrated, counted from 0
    sizes: tuple[int, ...]  # planets of each group
    group: tuple[int, ...]  # of every planet


def planet_groups(scene: Scene) -> PlanetGroups:
    """Those of a scene, in the order of their first planets."""
    looks = _looks(scene)
    distinct = list(dict.fromkeys(looks))
    return PlanetGroups(
        tuple(looks.index(look) for look in distinct),
        tuple(looks.count(look) for look in distinct),
        tuple(distinct.index(look) for look in looks),
    )


def scene_phases(scene: Scene) -> tuple[list[Fraction], list[Fraction]]:
    """Phases of sun and ring meshes [cycles], (planets,) each, see `mesh_phases`."""
    gearset = scene.gearset
    first, second = (mesh.coast_lead for mesh in gearset.geometry.meshes)
    return mesh_phases(gearset.tooth_numbers, gearset.planet_angles, (first, second))


def _looks(scene: Scene) -> list[_Look]:
    gearset = scene.gearset
    sun, ring = scene_phases(scene)
    faulty = {fault.planet - 1 for fault in scene.faults if fault.gear == "planet"}
    sun_cycles, ring_cycles = _period(scene, "sun"), _period(scene, "ring")
    return [
        (sun[i] % sun_cycles, ring[i] % ring_cycles, i if i in faulty else None)
        for i in range(gearset.planets)
    ]


def _period(scene: Scene, member: str) -> int:
    """Mesh cycles after which the meshes of sun or ring repeat, planets with faults left aside."""
    teeth = scene.gearset.tooth_numbers._asdict()
    uneven: set[str] = {fault.gear for fault in scene.faults if fault.gear == member}
    uneven |= {gear for gear in (member, "planet") if getattr(scene.mesh.runout, gear) != 0.0}
    return math.lcm(*(teeth[gear] for gear in uneven))
