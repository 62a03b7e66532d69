"""Helical gears: from the normal plane, in which drawings state them, to the transverse plane.

A rack tooth has its module, pressure angle and tip radius in the plane normal to its flanks.
Heights are the same in both planes; lengths along the pitch line are longer by 1/cos(beta) in the
transverse plane (ISO 21771:2007, sec. 4). So a coefficient h in normal modules is h cos(beta) in
transverse ones, and tan(alpha_t) = tan(alpha_n)/cos(beta).
"""

from __future__ import annotations

import math
from dataclasses import replace

from .gear_set import Sizes
from .involute import SpurGear
from .shift import PerGear


def transverse_angle(angle: float, helix: float) -> float:
    """Pressure angle in the transverse plane [rad].

    Args:
        angle: pressure angle in the normal plane [rad].
        helix: helix angle on the same circle [rad].
    """
    return math.atan(math.tan(angle) / math.cos(helix)) if helix else angle


def normal_angle(angle: float, helix: float) -> float:
    """Pressure angle in the normal plane [rad], from that in the transverse plane.

    Args:
        angle: pressure angle in the transverse plane [rad].
        helix: helix angle on the same circle [rad].
    """
    return math.atan(math.tan(angle) * math.cos(helix)) if helix else angle


def transverse_sizes(normal: Sizes, helix: float) -> Sizes:
    """Sizes of the transverse plane.

    Args:
        normal: sizes with module, pressure angle and coefficients of the normal plane.
        helix: helix angle on the reference circles [rad].
    """
    angle, cosine = transverse_angle(normal.pressure_angle, helix), math.cos(helix)
    return replace(
        normal,
        module=normal.module / cosine,
        pressure_angle=angle,
        addendum=normal.addendum * cosine,
        shift=PerGear(*(x * cosine for x in normal.shift)),
        dedendum=normal.dedendum * cosine,
        fillet=normal.fillet * cosine * _narrowing(normal.pressure_angle, angle),
        stated=cosine,
    )


def virtual_gear(gear: SpurGear, helix: float) -> SpurGear:
    """The spur gear whose teeth are those of a helical gear in its normal plane.

    It has z/(cos^2(beta_b) cos(beta)) teeth (ISO 6336-3:2019): so its radius of curvature is that
    of the helical flank, rho_t/cos(beta_b), at the same height of the tooth.

    Args:
        gear: the gear in the transverse plane.
        helix: helix angle on the reference circle [rad].
    """
    if helix == 0.0:
        return gear
    angle, cosine = normal_angle(gear.pressure_angle, helix), math.cos(helix)
    base = base_helix(gear.pressure_angle, helix)
    return replace(
        gear,
        teeth=gear.teeth / (math.cos(base) ** 2 * cosine),
        module=gear.module * cosine,
        pressure_angle=angle,
        addendum=gear.addendum / cosine,
        profile_shift=gear.profile_shift / cosine,
        dedendum=gear.dedendum / cosine,
        fillet=gear.fillet / (cosine * _narrowing(angle, gear.pressure_angle)),
    )


def base_helix(pressure_angle: float, helix: float) -> float:
    """Helix angle on the base circle [rad], tan(beta_b) = tan(beta) cos(alpha_t).

    Args:
        pressure_angle: in the transverse plane [rad].
        helix: helix angle on the reference circle [rad].
    """
    return math.atan(math.tan(helix) * math.cos(pressure_angle))


def _narrowing(normal: float, transverse: float) -> float:
    """Tip radius of a rack in the transverse plane over that in the normal plane.

    The straight flank ends at the same depth in both planes, the radius times 1 - sin(alpha) from
    the tip.
    """
    return (1.0 - math.sin(normal)) / (1.0 - math.sin(transverse))
