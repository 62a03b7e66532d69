"""Profile of a loaded tooth: thickness as a function of height, and direction of the load.

Sections are normal to the centre line of the tooth. Heights of external and internal teeth are
measured towards the tip, from the chord between the ends of the fillets on the root circle. They
do not depend on whether the root circle or the base circle is larger.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..gearset.involute import SpurGear
from .beam import Load
from .fillet import Fillet, fillet

POINTS = 400  # of the outline on the fillet, and on the flank
CRITICAL_TANGENT = {False: math.radians(30.0), True: math.radians(60.0)}  # by SpurGear.internal

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ToothProfile:
    """A tooth of a gear with its root fillets."""

    gear: SpurGear

    @cached_property
    def fillet(self) -> Fillet:
        """Radius [m] and half angle [rad] from the root circle (0) to the flank (1)."""
        return fillet(self.gear)

    @cached_property
    def root_half_angle(self) -> float:
        """Half the angle between the ends of the two fillets on the root circle [rad]."""
        return float(self.fillet(np.array(0.0))[1])

    @cached_property
    def flank_start(self) -> float:
        """Radius at which the involute starts [m]."""
        return float(self.fillet(np.array(1.0))[0])

    @cached_property
    def outline(self) -> tuple[Floats, Floats]:
        """Height and half thickness [m] from root to tip; the first `POINTS` are on the fillet."""
        radii = np.linspace(self.flank_start, self.gear.tip_radius, POINTS + 1)[1:]
        fillet_height, fillet_half = self._chord(*self.fillet(np.linspace(0.0, 1.0, POINTS)))
        height, half = self._chord(radii, self.gear.half_thickness(radii))
        # The root circle of an internal tooth is partly below its chord.
        rising = np.maximum.accumulate(np.append(fillet_height, height))
        return rising, np.append(fillet_half, half)

    @cached_property
    def critical_height(self) -> float:
        """Height [m] of the critical section of ISO 6336-3.

        The angle between the tangent of the fillet and the centre line is 30 deg there, for
        internal teeth 60 deg.
        """
        height, half = (x[:POINTS] for x in self.outline)
        steepness = np.arctan2(np.diff(half), np.diff(height))  # rises from -90 deg
        middle = 0.5 * (height[1:] + height[:-1])
        return float(np.interp(-CRITICAL_TANGENT[self.gear.internal], steepness, middle))

    @property
    def knots(self) -> tuple[float, float]:
        """Heights at which the thickness is not smooth: critical section, end of the fillet [m]."""
        return self.critical_height, float(self.outline[0][POINTS - 1])

    def thickness(self, height: Floats) -> Floats:
        """Thickness of sections [m], any shape.

        Args:
            height: heights of the sections [m], any shape.
        """
        return 2.0 * np.interp(height, *self.outline)

    def load(self, radius: Floats) -> Load:
        """Unit forces normal to the flank.

        The angle to the normal of the centre line is the pressure angle at the load minus the half
        angle of the tooth there. On an internal tooth, whose flank is inclined to the other side,
        it is their sum, tan(a) + pi/2z - inv(alpha).

        Args:
            radius: radii of the loaded points [m], (m,).

        Returns:
            The unit forces, (m,).
        """
        half = self.gear.half_thickness(radius)
        local = np.arccos(self.gear.base_radius / radius)
        angle = local + half if self.gear.internal else local - half
        height, half_chord = self._chord(radius, half)
        return Load(height - half_chord * np.tan(angle), angle)

    def depth(self, radius: Floats) -> Floats:
        """Distance along the line of action from the flank to the centre line [m], (m,).

        Args:
            radius: radii of the points on the flank [m], (m,).
        """
        return radius * np.sin(self.gear.half_thickness(radius)) / np.cos(self.load(radius).angle)

    def _chord(self, radius: Floats, half: Floats) -> tuple[Floats, Floats]:
        """Height above the root chord and half thickness [m] of the section through a point."""
        height = radius * np.cos(half) - self.gear.root_radius * math.cos(self.root_half_angle)
        return (-height if self.gear.internal else height), radius * np.sin(half)
