"""Form and stress correction factors of external teeth, ISO 6336-3:2019 (method B).

They give the stress at the root where a tangent at 30 degrees to the centre line of the tooth
touches the fillet of a rack-cut tooth (Hofer 1947). Lengths are over the module.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ..gearset.involute import SpurGear
from ..gearset.shift import involute

SECTION = math.pi / 3.0  # of external teeth: the tangent is at 30 degrees to the centre line
SWEEPS = 100  # of a fixed point that contracts to a tenth in each
ENOUGH = 1e-14  # change of the angle [rad] at which it ends


class RootSection(NamedTuple):
    """The critical section of a tooth, over the module."""

    thickness: float
    """s_Fn, chord between the tangent points."""
    curvature: float
    """rho_F, radius of curvature of the fillet there."""
    angle: float
    """theta, auxiliary angle [rad]."""
    depth: float
    """G, auxiliary value."""


class RootFactors(NamedTuple):
    """Stress at the root over the nominal one, for a force at a point of the flank."""

    form: float
    """Y_F."""
    correction: float
    """Y_S."""
    arm: float
    """h_Fe, bending moment arm over the module."""

    def stress(self, force: float, face_width: float, module: float) -> float:
        """Local stress at the root after ISO 6336-3 method B factors [Pa].

        Args:
            force: tangential force at the reference circle [N].
            face_width: b [m].
            module: m [m].
        """
        return force / (face_width * module) * self.form * self.correction


def root_section(gear: SpurGear) -> RootSection:
    """The critical section of a tooth cut by its basic rack without protuberance.

    Args:
        gear: an external spur gear, or the virtual one of a helical gear.

    Returns:
        The section (ISO 6336-3:2019, eq. 10 to 16).

    Raises:
        ValueError: the gear is internal: its root is not cut by a rack.
    """
    if gear.internal:
        raise ValueError("internal = True: the form factors are those of external teeth")
    teeth, tip, alpha = gear.teeth, gear.fillet, gear.pressure_angle
    rack = 0.25 * math.pi - gear.dedendum * math.tan(alpha)
    rack -= (1.0 - math.sin(alpha)) * tip / math.cos(alpha)  # E
    depth = tip - gear.dedendum + gear.profile_shift  # G
    opening = 2.0 / teeth * (0.5 * math.pi - rack) - SECTION  # H
    angle = math.pi / 6.0
    for _ in range(SWEEPS):
        last, angle = angle, 2.0 * depth / teeth * math.tan(angle) - opening
        if abs(angle - last) < ENOUGH:
            break
    cosine = math.cos(angle)
    chord = teeth * math.sin(SECTION - angle) + math.sqrt(3.0) * (depth / cosine - tip)
    fillet = tip + 2.0 * depth**2 / (cosine * (teeth * cosine**2 - 2.0 * depth))
    return RootSection(chord, fillet, angle, depth)


def root_factors(gear: SpurGear, radius: float) -> RootFactors:
    """Factors for a force on the flank.

    Args:
        gear: an external spur gear, or the virtual one of a helical gear.
        radius: at which the force acts on the flank [m].

    Returns:
        Y_F and Y_S (ISO 6336-3:2019, eq. 9, 22 to 26).

    Raises:
        ValueError: the gear is internal, or the radius is not on the involute.
    """
    if not gear.base_radius <= radius <= gear.tip_radius * (1.0 + 1e-12):
        raise ValueError(
            f"radius = {radius:.6g} m: must be within {gear.base_radius:.6g} and "
            f"{gear.tip_radius:.6g}, the involute of the tooth"
        )
    section, alpha, teeth = root_section(gear), gear.pressure_angle, gear.teeth
    profile = math.acos(gear.base_radius / radius)
    half = (0.5 * math.pi + 2.0 * gear.profile_shift * math.tan(alpha)) / teeth
    centre = half + involute(alpha) - involute(profile)  # gamma_e
    load = profile - centre  # alpha_Fen
    lever = (math.cos(centre) - math.sin(centre) * math.tan(load)) * 2.0 * radius / gear.module
    foot = teeth * math.cos(SECTION - section.angle)
    foot += section.depth / math.cos(section.angle) - gear.fillet
    arm = 0.5 * (lever - foot)
    form = 6.0 * arm * math.cos(load) / (section.thickness**2 * math.cos(alpha))
    slenderness, notch = section.thickness / arm, 0.5 * section.thickness / section.curvature
    correction = (1.2 + 0.13 * slenderness) * notch ** (1.0 / (1.21 + 2.3 / slenderness))
    return RootFactors(form, correction, arm)


def outer_single_contact(gear: SpurGear, contact_ratio: float) -> float:
    """Radius at the outer point of single pair tooth contact [m].

    When a pair arrives there, the next pair has just come into contact (ISO 6336-3:2019, eq. 20).

    Args:
        gear: the gear, the tip of which ends the contact.
        contact_ratio: transverse contact ratio, from 1 to 2.
    """
    base, tip = gear.base_radius, gear.tip_radius
    pitch = math.pi * gear.module * math.cos(gear.pressure_angle)
    along = math.sqrt(tip**2 - base**2) - pitch * (contact_ratio - 1.0)
    return math.hypot(along, base)
