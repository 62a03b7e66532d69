"""Stiffness of a pair of teeth along its path of contact.

Two teeth, each on its gear body, and the contact between them in series. Positions are base
pitches past the pitch point, as everywhere; single and double contact follow from which pairs
are within the path.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..gearset.geometry import PathOfContact, base_pitch, planet_ring_path, sun_planet_path
from ..gearset.involute import SpurGear
from ..gearset.kinematics import Teeth
from .contact import Contact, ContactLaw
from .material import Material
from .spall import NO_SPALL, Spall
from .tooth import HUB, RIM, Tooth

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ToothPair:
    """Two teeth in mesh: `first` (sun, or planet at the ring) drives, on the given path.

    The path stays on the line of action between the base circles, see `gearset.geometry`.
    """

    first: Tooth
    second: Tooth
    path: PathOfContact
    contact: ContactLaw
    spall: Spall = NO_SPALL

    @property
    def _gears(self) -> tuple[SpurGear, SpurGear]:
        return self.first.gear, self.second.gear

    @property
    def _ends(self) -> tuple[float, float]:
        return -self.path.approach, self.path.recess

    def _strings(self, position: Floats) -> tuple[Floats, Floats]:
        """Distance of the contact from where the line of action touches each base circle [m]."""
        first, second = self._gears
        moved = position * base_pitch(first.module, first.pressure_angle)
        tangent = math.tan(first.pressure_angle)
        return (
            first.base_radius * tangent + moved,
            second.base_radius * tangent + (moved if second.internal else -moved),
        )

    def radii(self, position: Floats) -> tuple[Floats, Floats]:
        """Radii [m] of the contact point on both gears, for positions in base pitches (m,)."""
        strings = self._strings(position)
        first, second = (
            np.hypot(gear.base_radius, string)
            for gear, string in zip(self._gears, strings, strict=True)
        )
        return first, second

    def compliance(self, position: Floats) -> Floats:
        """Approach of the gears per unit load, times face width [m^2/N], (m,)."""
        radii = self.radii(position)
        beams = self.first.beam(radii[0]) + self.second.beam(radii[1])
        bodies = self.first.body(radii[0]) + self.second.body(radii[1])
        return beams + bodies + self._local(position)

    def _local(self, position: Floats) -> Floats:
        """Compliance of the contact itself."""
        first, second = self._strings(position)
        curvature = 1.0 / first + (-1.0 if self.second.gear.internal else 1.0) / second
        at = self.radii(position)
        depths = self.first.profile.depth(at[0]), self.second.profile.depth(at[1])
        local = self.contact(Contact(1.0 / curvature, depths), self.first.material)
        return local / self.spall.contact_share(position)

    def stiffness(self, position: Floats, face_width: float) -> Floats:
        """Stiffness [N/m] along the line of action, for positions in base pitches (m,).

        The law holds on the path of contact and goes on smoothly a little beyond its ends.
        """
        return face_width / self.compliance(position)

    def double_contact_stiffness(self, position: Floats, face_width: float) -> Floats:
        """Stiffness [N/m] of this pair and the one a base pitch ahead, on shared gear bodies.

        A load on one tooth also moves its neighbour, so two pairs are less than twice as stiff as
        one (Xie, Hua, Han and Huang 2018): with compliances c_ij the stiffness is the sum of the
        elements of the inverse matrix. Both pairs share the approach of the gears.
        """
        here, ahead, shared = self._two_pairs(position)
        return face_width * (here + ahead - 2.0 * shared) / (here * ahead - shared**2)

    @property
    def shared_body_factor(self) -> float:
        """Stiffness of two pairs over the sum of what each has alone, mean over double contact.

        1 where the path never holds two pairs.
        """
        low, high = self._ends
        if high - low <= 1.0:
            return 1.0
        here, ahead, shared = self._two_pairs(np.linspace(low, high - 1.0, 33))
        together = (here + ahead - 2.0 * shared) / (here * ahead - shared**2)
        return float(np.mean(together / (1.0 / here + 1.0 / ahead)))

    def _two_pairs(self, position: Floats) -> tuple[Floats, Floats, Floats]:
        """Compliances of this pair, of the one ahead, and what a load on one moves the other."""
        near, far = self.radii(position), self.radii(position + 1.0)
        # The load points against the motion of the driving gear and along that of the driven one,
        # and the other pair is ahead.
        shared = self.first.body_coupling(near[0], far[0], 1)
        shared = shared + self.second.body_coupling(far[1], near[1], 1)
        return self.compliance(position), self.compliance(position + 1.0), shared


def sun_planet_pair(
    teeth: Teeth,
    module: float,
    pressure_angle: float,
    addendum: float,
    material: Material,
    contact: ContactLaw,
) -> ToothPair:
    """The external mesh: `module` [m], `pressure_angle` [rad], `addendum` [modules]."""
    sun, planet = (
        Tooth(SpurGear(z, module, pressure_angle, addendum), material, HUB)
        for z in (teeth.sun, teeth.planet)
    )
    return ToothPair(sun, planet, sun_planet_path(teeth, pressure_angle, addendum), contact)


def planet_ring_pair(
    teeth: Teeth,
    module: float,
    pressure_angle: float,
    addendum: float,
    material: Material,
    contact: ContactLaw,
) -> ToothPair:
    """The internal mesh: `module` [m], `pressure_angle` [rad], `addendum` [modules]."""
    planet = Tooth(SpurGear(teeth.planet, module, pressure_angle, addendum), material, HUB)
    ring = Tooth(SpurGear(teeth.ring, module, pressure_angle, addendum, True), material, RIM)
    return ToothPair(planet, ring, planet_ring_path(teeth, pressure_angle, addendum), contact)
