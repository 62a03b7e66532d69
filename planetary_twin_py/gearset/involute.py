"""Shape of involute spur gears, external and internal.

The flanks are involutes of the base circle r cos(alpha). The thickness on the reference circle is m
(pi/2 + 2 x tan(alpha)) with the profile shift x (ISO 21771:2007, eq. 34; no backlash): a positive
shift makes the teeth of external and internal gears thicker. The root is simplified: if the root
circle is inside the base circle, a radial line connects it to the start of the involute, instead of
the trochoid that a hob would cut.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .geometry import pitch_radius

DEDENDUM = 1.25  # [modules] of basic rack A of ISO 53
TIP_ROUNDING = 0.38  # [modules] of the same
_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class SpurGear:
    """A spur gear.

    Raises:
        ValueError: the teeth would be pointed, or the tip circle of an internal gear is inside its
            base circle.
    """

    teeth: float
    """Number of teeth; a whole number, except of virtual gears."""
    module: float
    """[m]"""
    pressure_angle: float
    """[rad]"""
    addendum: float = 1.0
    """Height of the tip above the reference circle, without profile shift [modules]."""
    internal: bool = False
    """Whether the teeth point inwards."""
    profile_shift: float = 0.0
    """x, positive if it makes the teeth thicker [modules]."""
    dedendum: float = DEDENDUM
    """Of the basic rack [modules]."""
    fillet: float = TIP_ROUNDING
    """Tip radius of the basic rack [modules]."""
    stated: float = 1.0
    """Module of the coefficients in the scene, which messages use [modules]."""

    def __post_init__(self) -> None:
        if self.internal and self.tip_radius <= self.base_radius:
            raise ValueError(f"teeth = {self.teeth}: the ring's tips are inside its base circle")
        if self.half_thickness(np.array(self.tip_radius)) <= 0.0:
            raise ValueError(f"teeth = {self.teeth}: the tooth is pointed below its tip circle")

    @property
    def pitch_radius(self) -> float:
        """Radius of the reference circle m z/2 [m]."""
        return pitch_radius(self.teeth, self.module)

    @property
    def tip_height(self) -> float:
        """Height of the tip above the reference circle, towards the tip [modules]."""
        return self.addendum + self.profile_shift

    @property
    def base_radius(self) -> float:
        """Radius of the base circle, at which the involute starts [m]."""
        return self.pitch_radius * math.cos(self.pressure_angle)

    @property
    def tip_radius(self) -> float:
        """Radius of the tip circle [m]."""
        height = self.tip_height * self.module
        return self.pitch_radius + (-height if self.internal else height)

    @property
    def root_radius(self) -> float:
        """Radius of the root circle [m]."""
        depth = (self.dedendum - self.profile_shift) * self.module
        return self.pitch_radius + (depth if self.internal else -depth)

    def half_thickness(self, radius: NDArray[np.float64]) -> NDArray[np.float64]:
        """Half the angle that a tooth spans on circles about the gear axis [rad], any shape.

        Args:
            radius: of the circles [m], any shape.
        """
        local = np.arccos(self.base_radius / np.maximum(radius, self.base_radius))
        thinning = _involute(local) - _involute(np.array(self.pressure_angle))
        half = 0.5 * math.pi / self.teeth
        if self.profile_shift != 0.0:
            half += 2.0 * self.profile_shift * math.tan(self.pressure_angle) / self.teeth
        return half + (thinning if self.internal else -thinning)

    def tooth(self, points: int = 9) -> NDArray[np.float64]:
        """Outline of a tooth and the root land after it.

        Args:
            points: number of points on each flank.

        Returns:
            Polar points (radius [m], angle [rad]) counter-clockwise, (k, 2). The tooth is centred
            at angle zero.
        """
        start = max(self.root_radius, self.base_radius)
        radii = np.linspace(start, self.tip_radius, points)
        if self.root_radius < start:
            radii = np.concatenate(([self.root_radius], radii))
        half = self.half_thickness(radii)
        tip = half[-1] * np.array([-0.5, 0.0, 0.5])
        gap = _TURN / self.teeth - 2.0 * half[0]
        root = half[0] + gap * np.array([0.25, 0.5, 0.75])
        return np.concatenate(
            (
                np.column_stack((radii, -half)),
                np.column_stack((np.full(3, self.tip_radius), tip)),
                np.column_stack((radii, half))[::-1],
                np.column_stack((np.full(3, self.root_radius), root)),
            )
        )

    def outline(self, points: int = 9) -> NDArray[np.float64]:
        """Outline of the gear.

        Args:
            points: number of points on each flank.

        Returns:
            Polar points (radius [m], angle [rad]) counter-clockwise, (k, 2), starting with those of
            `tooth`.
        """
        tooth = self.tooth(points)
        teeth = np.arange(self.teeth)
        outline = np.tile(tooth, (len(teeth), 1))
        outline[:, 1] += np.repeat(_TURN / self.teeth * teeth, len(tooth))
        return outline


def _involute(angle: NDArray[np.float64]) -> NDArray[np.float64]:
    """Involute function tan(a) - a [rad]."""
    return np.tan(angle) - angle
