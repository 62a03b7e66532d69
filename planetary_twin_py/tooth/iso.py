"""Tooth stiffness of external gears by ISO 6336-1:2019, clause 9 (method B).

A regression over measured and computed steel gears: an independent check on what is computed from
the tooth. Stiffnesses are per face width.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .material import Material

STEEL = 206e9  # Pa: the modulus the regression holds for
CORRECTION = 0.8  # C_M: measured over theoretical stiffness of solid disc gears
# q' = C1 + C2/zn1 + C3/zn2 + C4 x1 + C5 x1/zn1 + C6 x2 + C7 x2/zn2 + C8 x1^2 + C9 x2^2
_Q = (0.04723, 0.15551, 0.25791, -0.00635, -0.11654, -0.00193, -0.24188, 0.00529, 0.00182)
_UNIT = 1e9  # N/(mm um) in Pa


@dataclass(frozen=True)
class IsoPair:
    """A pinion (`teeth`[0]) and its gear, solid discs: C_R = 1.

    `teeth` are virtual tooth numbers z_n where the gears are helical; math.inf for a rack or, as
    the standard has it, an internal gear. `dedendum` h_fP [modules] is that of the basic rack.
    """

    teeth: tuple[float, float]
    pressure_angle: float
    profile_shift: tuple[float, float] = (0.0, 0.0)
    dedendum: float = 1.25
    helix_angle: float = 0.0

    @property
    def theoretical(self) -> float:
        """c'_th = 1/q' of a pair of teeth [Pa]: stiffness per face width."""
        (z1, z2), (x1, x2) = self.teeth, self.profile_shift
        terms = (1.0, 1.0 / z1, 1.0 / z2, x1, x1 / z1, x2, x2 / z2, x1**2, x2**2)
        return _UNIT / sum(c * term for c, term in zip(_Q, terms, strict=True))

    @property
    def basic_rack_factor(self) -> float:
        """C_B of the basic rack's dedendum and pressure angle."""
        by_angle = 1.0 - 0.02 * (20.0 - math.degrees(self.pressure_angle))
        return (1.0 + 0.5 * (1.2 - self.dedendum)) * by_angle

    def single(self, material: Material) -> float:
        """c' = c'_th C_M C_R C_B cos(beta), the largest stiffness of one pair of teeth [Pa].

        For line loads of 100 N/mm and more, whole teeth of one material.
        """
        factors = CORRECTION * self.basic_rack_factor * math.cos(self.helix_angle)
        return self.theoretical * factors * material.youngs_modulus / STEEL

    def mesh(self, material: Material, contact_ratio: float) -> float:
        """c_gamma,alpha = c' (0.75 eps_alpha + 0.25), the mean over a mesh cycle [Pa]."""
        return self.single(material) * (0.75 * contact_ratio + 0.25)
