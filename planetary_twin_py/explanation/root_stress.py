"""Stress at the root of teeth under the static force of a mesh."""

from __future__ import annotations

import math

from ..durability.root_form import outer_single_contact, root_factors
from ..scene import Scene


def root_stresses(scene: Scene, force: float, kind: int) -> tuple[float, ...]:
    """Largest local stress at the roots of a mesh.

    One pair carries the force at the outer point of single contact of each gear, evenly along the
    face (ISO 6336-3:2019, method B form factors).

    Args:
        scene: the scene.
        force: force of the mesh [N], not negative.
        kind: 0 for sun-planet meshes, 1 for planet-ring meshes.

    Returns:
        Stress [Pa] of the external gears of the mesh; none of helical teeth, and none where two
        pairs are in contact at all times, for which these factors do not hold.
    """
    gearset = scene.gearset
    mesh = gearset.geometry.meshes[kind]
    if gearset.helix_angle != 0.0 or mesh.path.contact_ratio >= 2.0:
        return ()
    stresses = []
    for gear in (mesh.first, mesh.second):
        if gear.internal:
            continue
        factors = root_factors(gear, outer_single_contact(gear, mesh.path.contact_ratio))
        along = force * math.cos(gear.pressure_angle)  # at the reference circle
        stresses.append(factors.stress(along, gearset.face_width, gear.module))
    return tuple(stresses)
