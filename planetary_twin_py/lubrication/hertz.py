"""Elastic line contact (Hertz 1882; Johnson, Contact Mechanics, 1985, eq. 4.45)."""

from __future__ import annotations

import math

from .._compile import law


@law
def half_width(load: float, radius: float, face_width: float, contact_modulus: float) -> float:
    """Half-width b of the contact [m].

    Args:
        load: normal load [N].
        radius: reduced radius of curvature R, 1/R = 1/R1 +- 1/R2 [m].
        face_width: length of the contact L [m].
        contact_modulus: E*, 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2 [Pa].
    """
    return math.sqrt(4.0 * load * radius / (math.pi * face_width * contact_modulus))


def contact_modulus(youngs_modulus: float, poisson_ratio: float) -> float:
    """E* [Pa] of two bodies of the same material."""
    return youngs_modulus / (2.0 * (1.0 - poisson_ratio**2))
