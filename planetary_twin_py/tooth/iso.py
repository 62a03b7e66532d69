"""Tooth stiffness of external gears by ISO 6336-1:2019, clause 9 (method B).

It is a regression over measured and computed steel gears. `explain` prints it beside the stiffness
that is computed from the tooth. Stiffnesses are per face width.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..gearset.normal_plane import virtual_gear
from ..gearset.working import WorkingMesh
from .material import Material

STEEL = 206e9  # [Pa] Young's modulus of the regression
LIGHT = 1e5  # [N/m] line load below which pairs are softer
CORRECTION = 0.8  # C_M: measured over theoretical stiffness of solid disc gears
# q' = C1 + C2/zn1 + C3/zn2 + C4 x1 + C5 x1/zn1 + C6 x2 + C7 x2/zn2 + C8 x1^2 + C9 x2^2
_Q = (0.04723, 0.15551, 0.25791, -0.00635, -0.11654, -0.00193, -0.24188, 0.00529, 0.00182)
_UNIT = 1e9  # N/(mm um) in Pa


@dataclass(frozen=True)
class IsoPair:
    """A pinion and a gear, both solid discs (C_R = 1)."""

    teeth: tuple[float, float]
    """Tooth numbers of pinion and gear, virtual ones z_n for helical gears; math.inf for a rack
    and, as in the standard, for an internal gear."""
    pressure_angle: float
    """[rad]"""
    profile_shift: tuple[float, float] = (0.0, 0.0)
    """Of pinion and gear [modules]."""
    dedendum: float = 1.25
    """h_fP of the basic rack [modules]."""
    helix_angle: float = 0.0
    """[rad]"""

    @property
    def theoretical(self) -> float:
        """Theoretical single stiffness c'_th = 1/q' per face width [Pa]."""
        (z1, z2), (x1, x2) = self.teeth, self.profile_shift
        terms = (1.0, 1.0 / z1, 1.0 / z2, x1, x1 / z1, x2, x2 / z2, x1**2, x2**2)
        return _UNIT / sum(c * term for c, term in zip(_Q, terms, strict=True))

    @property
    def basic_rack_factor(self) -> float:
        """Basic rack factor C_B."""
        by_angle = 1.0 - 0.02 * (20.0 - math.degrees(self.pressure_angle))
        return (1.0 + 0.5 * (1.2 - self.dedendum)) * by_angle

    def single(self, material: Material, line_load: float = LIGHT) -> float:
        """Single stiffness c' = c'_th C_M C_R C_B cos(beta): the maximum of one tooth pair [Pa].

        Below 100 N/mm it falls with the line load to the power 1/4.

        Args:
            material: of both gears.
            line_load: force over the face width [N/m].
        """
        factors = CORRECTION * self.basic_rack_factor * math.cos(self.helix_angle)
        factors *= min(1.0, line_load / LIGHT) ** 0.25
        return self.theoretical * factors * material.youngs_modulus / STEEL

    def mesh(self, material: Material, contact_ratio: float, line_load: float = LIGHT) -> float:
        """Mesh stiffness c_gamma,alpha = c' (0.75 eps_alpha + 0.25), a mean over the cycle [Pa].

        Args:
            material: of both gears.
            contact_ratio: transverse contact ratio eps_alpha.
            line_load: force over the face width [N/m].
        """
        return self.single(material, line_load) * (0.75 * contact_ratio + 0.25)


def iso_pair(mesh: WorkingMesh, helix: float) -> IsoPair:
    """Pinion and gear of a mesh by their virtual gears; the gear is a rack in place of a ring.

    Args:
        mesh: of two gears in the transverse plane.
        helix: helix angle on the reference circles [rad].
    """
    gears = [virtual_gear(gear, helix) for gear in (mesh.first, mesh.second)]
    pinion, gear = sorted(gears, key=lambda gear: gear.teeth)
    return IsoPair(
        (pinion.teeth, math.inf if gear.internal else gear.teeth),
        pinion.pressure_angle,
        (pinion.profile_shift, gear.profile_shift),
        pinion.dedendum,
        helix,
    )
