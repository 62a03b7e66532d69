"""Whether teeth fit into each other: backlash, tip clearance, and tips of internal meshes.

Each check yields messages of one line with field, value and allowed range.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from .gear_set import GearSet
from .shift import involute
from .working import WorkingMesh

SENSE_OF_RING = "A positive shift makes teeth of the ring thicker (ISO 21771)"
OVERLAP_TOLERANCE = 0.01  # [modules] overlap that the rounding of published shifts may leave


def check_fit(gears: GearSet) -> Iterator[str]:
    """Errors of the meshes of a gear set.

    Args:
        gears: sun, planet and ring at their centre distance.

    Yields:
        One line per error; of teeth that overlap no others, which may follow from it.
    """
    overlaps = [line for mesh in gears.meshes for line in _overlap(mesh)]
    if overlaps:
        yield from overlaps
        return
    for mesh in gears.meshes:
        try:
            path = mesh.path
        except ValueError as error:
            yield str(error)
            continue
        yield from _tips(mesh)
        if path.contact_ratio <= 1.0:
            yield (
                f"contact ratio of {' and '.join(mesh.names)} = {path.contact_ratio:.4g}: must be "
                "above 1: increase gearset.addendum or gearset.tip_diameter"
            )
        if mesh.internal:
            yield from _trochoid(mesh)


def tip_passage(mesh: WorkingMesh) -> float:
    """Angle of the ring by which tips pass each other outside the path of contact [rad].

    Tips of planet and ring leave each other where their tip circles intersect. Below zero they
    would overlap there (trochoidal interference, JGMA 611-01; Colbourne 1987, sec. 8.6):
    z1/z2 (t1 + inv a_a1 - inv a_w) + inv a_w - inv a_a2 - t2 with the directions t1 and t2 of the
    intersection from both centres.

    Args:
        mesh: of planet and ring.

    Returns:
        The angle; infinite if the tip circles do not intersect.
    """
    (inner, outer), distance = (mesh.first, mesh.second), mesh.centre_distance
    tip1, tip2 = inner.tip_radius, outer.tip_radius
    if not abs(tip2 - tip1) < distance < tip1 + tip2:
        return math.inf
    first = math.acos((tip2**2 - tip1**2 - distance**2) / (2.0 * distance * tip1))
    second = math.acos((tip2**2 - tip1**2 + distance**2) / (2.0 * distance * tip2))
    at_tip1, at_tip2, at_pitch = (
        involute(math.acos(inner.base_radius / tip1)),
        involute(math.acos(outer.base_radius / tip2)),
        involute(mesh.pressure_angle),
    )
    turned = inner.teeth / outer.teeth * (first + at_tip1 - at_pitch)
    return turned + at_pitch - at_tip2 - second


def _overlap(mesh: WorkingMesh) -> Iterator[str]:
    """Error of teeth that are thicker than the gaps they are in."""
    try:
        backlash, module = mesh.backlash, mesh.first.module
    except ValueError:  # no line of action, which is an error of the path of contact
        return
    if backlash < -OVERLAP_TOLERANCE * module:
        most = mesh.shift + backlash / (2.0 * module * math.sin(mesh.first.pressure_angle))
        (first, second), stated = mesh.names, mesh.first.stated
        yield (
            f"gearset.profile_shift.{first} + {second} = {mesh.shift / stated:.4g}: must be at "
            f"most {most / stated:.4g} at gearset.centre_distance = "
            f"{1e3 * mesh.centre_distance:.6g} mm: the teeth overlap by "
            f"{-1e3 * backlash:.3g} mm{_sign_of_ring(mesh)}"
        )


def _sign_of_ring(mesh: WorkingMesh) -> str:
    """Hint if the shift of the ring fits with the other sign."""
    ring, module = mesh.second.profile_shift, mesh.first.module
    backlash = mesh.backlash + 4.0 * ring * module * math.sin(mesh.first.pressure_angle)
    if not mesh.internal or backlash < -OVERLAP_TOLERANCE * module:
        return ""
    return (
        f". {SENSE_OF_RING}; if its source counts it outwards, set "
        f"gearset.profile_shift.ring = {-ring / mesh.second.stated:g}"
    )


def _tips(mesh: WorkingMesh) -> Iterator[str]:
    """Errors of tips that reach the mating root circle."""
    for name, mate, gear, clearance in zip(
        mesh.names, mesh.names[::-1], (mesh.first, mesh.second), mesh.tip_clearances, strict=True
    ):
        if clearance <= 0.0:
            sense = -1.0 if gear.internal else 1.0
            limit = 2e3 * (gear.tip_radius + sense * clearance)
            yield (
                f"gearset.tip_diameter.{name} = {2e3 * gear.tip_radius:.6g} mm: must be "
                f"{'above' if gear.internal else 'below'} {limit:.6g} mm, where its tips reach the "
                f"roots of the {mate}; or increase gearset.dedendum"
            )


def _trochoid(mesh: WorkingMesh) -> Iterator[str]:
    """Error of tips of planet and ring that meet outside the path of contact."""
    passage = tip_passage(mesh)
    if passage < 0.0:
        yield (
            f"gearset.teeth.ring = {mesh.second.teeth}: tips of ring and planets overlap by "
            f"{math.degrees(-passage):.3g} deg outside the path of contact (trochoidal "
            "interference): increase ring - planet teeth, or reduce a tip height"
        )
