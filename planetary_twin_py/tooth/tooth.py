"""Compliance of one tooth on its gear body."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from ..gearset.involute import SpurGear
from .beam import beam_compliance
from .crack import NO_CRACK, Crack
from .foundation import GearBody
from .material import Material
from .profile import ToothProfile

Floats = NDArray[np.float64]

HUB = 0.5  # [root radii] radius at which an external gear is held
RIM = 1.2  # [root radii] radius at which an internal gear is held


@dataclass(frozen=True)
class Tooth:
    """A tooth on a gear body that is rigidly held at one edge.

    Raises:
        ValueError: the held edge is on the wrong side of the root circle.
    """

    gear: SpurGear
    material: Material
    held: float
    """Radius of the held edge [root radii], 1/h of Sainsot et al. 2004: of the shaft or bearing in
    an external gear, or of the housing around an internal gear."""
    crack: Crack = NO_CRACK

    def __post_init__(self) -> None:
        if self.held <= 0.0 or self.held == 1.0 or (self.held > 1.0) != self.gear.internal:
            allowed = "above 1 (internal gear)" if self.gear.internal else "within 0 and 1"
            raise ValueError(f"held = {self.held:g} root radii: must be {allowed}")

    @cached_property
    def profile(self) -> ToothProfile:
        """Shape of the tooth."""
        return ToothProfile(self.gear)

    def beam(self, radius: Floats) -> Floats:
        """Compliance of bending, shear and compression, times face width [m^2/N], (m,).

        Args:
            radius: radii of the points on the flank at which a normal force acts [m], (m,).
        """
        profile = self.profile
        thickness = self.crack.thickness(profile)
        return beam_compliance(thickness, profile.knots, profile.load(radius), self.material)

    def body(self, radius: Floats) -> Floats:
        """Compliance of the gear body, times face width [m^2/N], (m,).

        Args:
            radius: radii of the points on the flank at which a normal force acts [m], (m,).
        """
        return self.body_coupling(radius, radius, 0)

    def body_coupling(self, radius: Floats, loaded: Floats, teeth: int) -> Floats:
        """Displacement of a tooth per load on another, times face width [m^2/N], (m,).

        Args:
            radius: radii of the displaced points [m], (m,); the displacement is along the line of
                action of that tooth.
            loaded: radii of the loaded points of the other tooth [m], (m,).
            teeth: number of teeth from the loaded to the displaced tooth.
        """
        pitch = 2.0 * math.pi / self.gear.teeth
        body = GearBody(self.held, self.profile.root_half_angle, self.material.poisson_ratio)
        matrix = _root_compliance(body, teeth * pitch)
        here, there = self._on_root(radius), self._on_root(loaded)
        return np.einsum("jm,jk,km->m", here, matrix, there) / self.material.youngs_modulus

    def _on_root(self, radius: Floats) -> Floats:
        """Moment [root radii], force across and force onto the root of unit loads, (3, m)."""
        crossing, angle = self.profile.load(radius)
        half = self.profile.root_half_angle
        middle = math.sin(half) / half - math.cos(half)  # height of the arc above its chord
        arm = crossing / self.gear.root_radius - (-middle if self.gear.internal else middle)
        return np.array([arm * np.cos(angle), np.cos(angle), np.sin(angle)])


@lru_cache(maxsize=64)  # series of a thousand terms, the same at all positions and loads
def _root_compliance(body: GearBody, neighbour: float) -> Floats:
    return body.compliance(neighbour)
