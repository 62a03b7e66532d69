"""Undercut: the rack that cuts a gear with few teeth removes the start of its involute."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..gearset.involute import SpurGear
from ..gearset.working import WorkingMesh
from .fillet import fillet, straight_reach

TOLERANCE = 2e-3  # [modules] loss of flank that is below its roughness in small gears
_END = np.array(1.0)  # of a fillet: where the involute starts


def least_shift(gear: SpurGear) -> float:
    """Profile shift from which the rack does not undercut [modules] (ISO 21771:2007, sec. 5.6).

    x = h - z sin^2(alpha)/2 with the height h of the rack's straight flank.

    Args:
        gear: an external gear.
    """
    height = straight_reach(gear) / gear.module + gear.profile_shift
    return height - 0.5 * gear.teeth * math.sin(gear.pressure_angle) ** 2


def check_undercut(mesh: WorkingMesh) -> Iterator[str]:
    """Errors of gears whose mates touch them where undercut has removed the involute.

    Args:
        mesh: mesh with a path of contact.

    Yields:
        One line per error.
    """
    pitch, path = mesh.base_pitch, mesh.path
    ends = (path.approach, path.recess)
    gears = (mesh.first, mesh.second)
    for name, mate, gear, curvature, end in zip(
        mesh.names, mesh.names[::-1], gears, mesh.curvatures, ends, strict=True
    ):
        if gear.internal or gear.profile_shift >= least_shift(gear):
            continue
        touched = math.hypot(gear.base_radius, curvature - end * pitch)
        involute_start = float(fillet(gear)(_END)[0])
        if touched < involute_start - TOLERANCE * gear.module:
            yield (
                f"gearset.profile_shift.{name} = {gear.profile_shift / gear.stated:g}: must be at "
                f"least {least_shift(gear) / gear.stated:.4g} for {gear.teeth} teeth: undercut "
                f"leaves no involute below {2e3 * involute_start:.6g} mm, and the {mate} touches "
                f"it from {2e3 * touched:.6g} mm"
            )
