"""Whether the backlash that a scene states contradicts its teeth."""

from __future__ import annotations

import math

from ..gearset.interference import SENSE_OF_RING
from ..scene import Scene
from ..units.conversion import customary

FINE = 0.02
"""Of the module: more than the tolerances of tooth thickness and centre distance."""
WIDE = 3.0
"""Times the stated one, which may be a mean of both meshes."""


def backlash_of_scene(scene: Scene) -> str | None:
    """Warn if teeth without tolerances have more backlash than the scene states.

    Tolerances of the tooth thickness add backlash, so less than stated is no contradiction.

    Returns:
        A sentence, or None.
    """
    gearset, point = scene.gearset, scene.operating_point
    plane = gearset.transverse
    stated = math.fsum(scene.mesh.flanks(point.backlash, plane.pressure_angle))
    most = WIDE * stated + FINE * plane.module
    for mesh in gearset.geometry.meshes:
        if mesh.backlash <= most:
            continue
        ring = mesh.second.profile_shift
        slope = 4.0 * mesh.first.module * math.sin(mesh.first.pressure_angle)
        hint = ""
        if mesh.internal and abs(mesh.backlash + slope * ring) <= most:
            right = -gearset.profile_shift.ring
            hint = f". {SENSE_OF_RING}; with gearset.profile_shift.ring = {right:g} both agree"
        return (
            f"profile shift and centre distance give the {'-'.join(mesh.names)} meshes a backlash "
            f"of {customary(mesh.backlash, 'm', 3)} on the line of action, and backlash states "
            f"{customary(stated, 'm', 3)}: one of them is wrong; runs have the stated one{hint}"
        )
    return None
