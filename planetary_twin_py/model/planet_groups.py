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
from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from ..scene import Scene
from ..scene.faults import distinct_planet, is_of_central_bearing, is_of_some_teeth

ROUNDING = 1e-9

# What determines the motion of a planet: phases of both meshes, its number if faults, errors of
# axes or weight distinguish it, and its own errors.
Signature = tuple[Fraction, Fraction, int | None, tuple[float, ...]]


class PlanetGroups(NamedTuple):
    """Groups of planets with the same motion."""

    leaders: tuple[int, ...]  # the integrated planet of each group, counted from 0
    sizes: tuple[int, ...]  # number of planets in each group
    group: tuple[int, ...]  # the group of each planet


def planet_groups(signatures: Sequence[Signature], apart: bool) -> PlanetGroups:
    """Groups of planets.

    Args:
        signatures: of each planet, see `signatures`.
        apart: whether every planet has a motion of its own.

    Returns:
        Groups of planets with equal signatures, in the order of their first planets.
    """
    if apart:
        each = tuple(range(len(signatures)))
        return PlanetGroups(each, (1,) * len(each), each)
    distinct = list(dict.fromkeys(signatures))
    return PlanetGroups(
        tuple(signatures.index(signature) for signature in distinct),
        tuple(signatures.count(signature) for signature in distinct),
        tuple(distinct.index(signature) for signature in signatures),
    )


def directions_cancel(signatures: Sequence[Signature], angles: Sequence[float]) -> bool:
    """Whether the directions of the planets with each signature have no resultant.

    Args:
        signatures: of each planet.
        angles: positions of the planets [rad], (planets,).
    """
    resultant: dict[Signature, complex] = defaultdict(complex)
    for signature, angle in zip(signatures, angles, strict=True):
        resultant[signature] += cmath.rect(1.0, angle)
    return all(abs(sum_) < ROUNDING for sum_ in resultant.values())


def signatures(scene: Scene, phases: tuple[list[Fraction], list[Fraction]]) -> list[Signature]:
    """What determines the motion of each planet.

    Args:
        scene: the scene.
        phases: of sun and ring meshes [cycles], (planets,) each.

    Returns:
        Signatures, which are equal for planets with the same motion.
    """
    sun, ring = phases
    heavy = scene.moving_axes and scene.supports is not None and scene.supports.gravity != 0.0
    errors = scene.errors
    apart = errors.of_axes or heavy or any(map(is_of_central_bearing, scene.faults))
    faulty = {distinct_planet(fault) for fault in scene.faults}
    sun_cycles, ring_cycles = _period(scene, "sun"), _period(scene, "ring")
    return [
        (
            sun[i] % sun_cycles,
            ring[i] % ring_cycles,
            i if i + 1 in faulty or apart else None,
            (*errors.of_planet(i), *scene.mesh.worn.of_planet(i)),
        )
        for i in range(scene.gearset.planets)
    ]


def _period(scene: Scene, member: str) -> int:
    """Mesh cycles after which the meshes of sun or ring repeat, without faults of planets."""
    teeth = scene.gearset.tooth_numbers._asdict()
    uneven: set[str] = {member for fault in scene.faults if is_of_some_teeth(fault, member)}
    uneven |= {gear for gear in (member, "planet") if getattr(scene.mesh.runout, gear) != 0.0}
    return math.lcm(*(teeth[gear] for gear in uneven))
