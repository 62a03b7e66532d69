"""Material of the teeth."""

from __future__ import annotations

from typing import NamedTuple


class Material(NamedTuple):
    """An isotropic elastic material."""

    youngs_modulus: float
    """[Pa]"""
    poisson_ratio: float

    @property
    def shear_modulus(self) -> float:
        """G = E/(2 (1 + nu)) [Pa]."""
        return self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))

    @property
    def plane_strain_modulus(self) -> float:
        """E/(1 - nu^2) [Pa]: modulus for bending and contact of a tooth much wider than thick."""
        return self.youngs_modulus / (1.0 - self.poisson_ratio**2)
