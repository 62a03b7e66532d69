"""Elastic line contact (Hertz 1882; Johnson, Contact Mechanics, 1985, eq. 4.43)."""

from __future__ import annotations


def contact_modulus(youngs_modulus: float, poisson_ratio: float) -> float:
    """E* [Pa] of two bodies of the same material."""
    return youngs_modulus / (2.0 * (1.0 - poisson_ratio**2))
