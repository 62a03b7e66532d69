"""Groups of planets with the same motion, of which one planet is integrated.

All planets start with the same state and share the load equally. Their motions differ only if
their meshes have different phases, if they have errors of their own or, where teeth differ, other
teeth in contact. Mesh phases are exact fractions, so the comparison is exact. Other differences
between real planets must be given in the scene. (Planets in phase: Kahraman 1994, Planetary gear
train dynamics; Parker and Lin 2004.)

Where axes move, the forces of every group on sun, ring and carrier must cancel as well. Then these
three are never displaced, and the planets of a group have the same motion on their pins.
"""

from __future__ import annotations

import cmath
import math
from collections import defaultdict
from fractions import Fraction
from typing import NamedTuple

from ..gearset.phasing import mesh_phases
from ..scene import Scene

ROUNDING = 1e-9

# What determines the motion of a planet: phases of both meshes, its number if faults, errors of
# axes or weight distinguish it, and its own errors.
_Signature = tuple[Fraction, Fraction, int | None, tuple[float, ...]]


class PlanetGroups(NamedTuple):
    """Groups of planets with the same motion."""

    leaders: tuple[int, ...]  # the integrated planet of each group, counted from 0
    sizes: tuple[int, ...]  # number of planets in each group
    group: tuple[int, ...]  # the group of each planet


def planet_groups(scene: Scene) -> PlanetGroups:
    """Groups of a scene, in the order of their first planets."""
    signatures = _signatures(scene)
    if scene.moving_axes and not _cancel(scene, signatures):
        each = tuple(range(len(signatures)))
        return PlanetGroups(each, (1,) * len(each), each)
    distinct = list(dict.fromkeys(signatures))
    return PlanetGroups(
        tuple(signatures.index(signature) for signature in distinct),
        tuple(signatures.count(signature) for signature in distinct),
        tuple(distinct.index(signature) for signature in signatures),
    )


def axes_stand(scene: Scene) -> bool:
    """Whether sun, ring and carrier cannot be displaced, as the forces on them cancel."""
    return _cancel(scene, _signatures(scene))


def scene_phases(scene: Scene) -> tuple[list[Fraction], list[Fraction]]:
    """Phases of sun and ring meshes [cycles], (planets,) each, see `mesh_phases`."""
    gearset = scene.gearset
    first, second = (mesh.coast_lead for mesh in gearset.geometry.meshes)
    return mesh_phases(gearset.tooth_numbers, gearset.planet_angles, (first, second))


def _cancel(scene: Scene, signatures: list[_Signature]) -> bool:
    """Whether the directions of the planets with each signature have no resultant."""
    resultant: dict[_Signature, complex] = defaultdict(complex)
    for signature, angle in zip(signatures, scene.gearset.planet_angles, strict=True):
        resultant[signature] += cmath.rect(1.0, angle)
    return all(abs(sum_) < ROUNDING for sum_ in resultant.values())


def _signatures(scene: Scene) -> list[_Signature]:
    gearset = scene.gearset
    sun, ring = scene_phases(scene)
    heavy = scene.moving_axes and scene.supports is not None and scene.supports.gravity != 0.0
    apart = scene.errors.of_axes or heavy
    faulty = {fault.planet - 1 for fault in scene.faults if fault.gear == "planet"}
    sun_cycles, ring_cycles = _period(scene, "sun"), _period(scene, "ring")
    return [
        (
            sun[i] % sun_cycles,
            ring[i] % ring_cycles,
            i if i in faulty or apart else None,
            scene.errors.of_planet(i),
        )
        for i in range(gearset.planets)
    ]


def _period(scene: Scene, member: str) -> int:
    """Mesh cycles after which the meshes of sun or ring repeat, without faults of planets."""
    teeth = scene.gearset.tooth_numbers._asdict()
    uneven: set[str] = {fault.gear for fault in scene.faults if fault.gear == member}
    uneven |= {gear for gear in (member, "planet") if getattr(scene.mesh.runout, gear) != 0.0}
    return math.lcm(*(teeth[gear] for gear in uneven))
