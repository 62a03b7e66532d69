"""Stiffness of a pair of teeth along its path of contact.

The compliances of two teeth, their gear bodies and the contact are in series. Positions are in base
pitches after the pitch point. The number of pairs in contact follows from the path of contact.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..gearset.geometry import PathOfContact, base_pitch
from ..gearset.involute import SpurGear
from .contact import Contact, ContactLaw
from .spall import NO_SPALL, Spall
from .tooth import Tooth

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ToothPair:
    """Two teeth in mesh."""

    first: Tooth
    """Tooth of the driving gear: of the sun, or of the planet in mesh with the ring."""
    second: Tooth
    """Tooth of the driven gear."""
    path: PathOfContact
    """Path of contact between the base circles, see `gearset.geometry`."""
    contact: ContactLaw
    spall: Spall = NO_SPALL
    angle: float | None = None
    """Working pressure angle [rad]; default: that of the gears."""
    pitch: float | None = None
    """Distance that the contact moves in a base pitch of positions [m]; default: the gears' base
    pitch. It is longer in the normal plane of helical teeth."""

    @property
    def _gears(self) -> tuple[SpurGear, SpurGear]:
        return self.first.gear, self.second.gear

    @property
    def _ends(self) -> tuple[float, float]:
        return -self.path.approach, self.path.recess

    def _tangent_lengths(self, position: Floats) -> tuple[Floats, Floats]:
        """Distance of the contact from the tangent point on each base circle [m]."""
        first, second = self._gears
        pitch = self.pitch or base_pitch(first.module, first.pressure_angle)
        moved = position * pitch
        tangent = math.tan(first.pressure_angle if self.angle is None else self.angle)
        return (
            first.base_radius * tangent + moved,
            second.base_radius * tangent + (moved if second.internal else -moved),
        )

    def radii(self, position: Floats) -> tuple[Floats, Floats]:
        """Radii of the contact point on both gears [m], (m,) each.

        Args:
            position: position after the pitch point [base pitches], (m,).
        """
        lengths = self._tangent_lengths(position)
        first, second = (
            np.hypot(gear.base_radius, length)
            for gear, length in zip(self._gears, lengths, strict=True)
        )
        return first, second

    def compliance(self, position: Floats) -> Floats:
        """Approach of the gears per unit load, times face width [m^2/N], (m,).

        Args:
            position: position after the pitch point [base pitches], (m,).
        """
        radii = self.radii(position)
        beams = self.first.beam(radii[0]) + self.second.beam(radii[1])
        bodies = self.first.body(radii[0]) + self.second.body(radii[1])
        return beams + bodies + self._local(position)

    def _local(self, position: Floats) -> Floats:
        """Compliance of the contact."""
        first, second = self._tangent_lengths(position)
        curvature = 1.0 / first + (-1.0 if self.second.gear.internal else 1.0) / second
        at = self.radii(position)
        depths = self.first.profile.depth(at[0]), self.second.profile.depth(at[1])
        local = self.contact(Contact(1.0 / curvature, depths), self.first.material)
        return local / self.spall.contact_share(position)

    def stiffness(self, position: Floats, face_width: float) -> Floats:
        """Stiffness along the line of action [N/m], (m,).

        The law is valid on the path of contact, and smooth slightly beyond its ends.

        Args:
            position: position after the pitch point [base pitches], (m,).
            face_width: [m].
        """
        return face_width / self.compliance(position)

    def double_contact_stiffness(self, position: Floats, face_width: float) -> Floats:
        """Stiffness of this pair and the next pair ahead, on common gear bodies [N/m], (m,).

        A load on one tooth also displaces its neighbour, so two pairs are less than twice as stiff
        as one (Xie, Hua, Han and Huang 2018). Both pairs have the same approach of the gears; the
        stiffness is therefore the sum of the elements of the inverse of the compliances c_ij.

        Args:
            position: position of this pair after the pitch point [base pitches], (m,).
            face_width: [m].
        """
        near, far = self.radii(position), self.radii(position + 1.0)
        # The load is opposite to the motion of the driving gear and along that of the driven gear;
        # the other pair is ahead.
        shared = self.first.body_coupling(near[0], far[0], 1)
        shared = shared + self.second.body_coupling(far[1], near[1], 1)
        here, ahead = self.compliance(position), self.compliance(position + 1.0)
        return face_width * (here + ahead - 2.0 * shared) / (here * ahead - shared**2)

    @property
    def shared_body_factor(self) -> float:
        """Stiffness of two pairs over the sum of their own, mean over double contact.

        It is 1 if there is no double contact.
        """
        low, high = self._ends
        if high - low <= 1.0:
            return 1.0
        here = np.linspace(low, high - 1.0, 33)
        apart = self.stiffness(here, 1.0) + self.stiffness(here + 1.0, 1.0)
        return float(np.mean(self.double_contact_stiffness(here, 1.0) / apart))
