"""The few numbers that fix a planetary gearset's shape, as drawing needs them."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class GearsetGeometry:
    """Shape of a planetary gearset of standard spur gears (no profile shift).

    `module` and `face_width` are in metres, `pressure_angle` and `planet_angles` (position of
    each planet on the carrier, counter-clockwise from +x) in radians. `held` names the member
    that stands still: "sun", "ring", "carrier" or None.
    """

    sun_teeth: int
    planet_teeth: int
    ring_teeth: int
    module: float
    pressure_angle: float
    planet_angles: tuple[float, ...]
    face_width: float
    held: str | None = "carrier"

    @property
    def planets(self) -> int:
        """Number of planets."""
        return len(self.planet_angles)

    @property
    def carrier_radius(self) -> float:
        """Distance from the sun's axis to a planet's [m]."""
        return 0.5 * self.module * (self.sun_teeth + self.planet_teeth)

    def pitch_radius(self, teeth: int) -> float:
        """Pitch radius [m] of a gear of this set with `teeth` teeth."""
        return 0.5 * self.module * teeth

    @property
    def members(self) -> tuple[str, ...]:
        """Names of the turning bodies: sun, planet_1..N, ring, carrier."""
        return ("sun", *(f"planet_{i + 1}" for i in range(self.planets)), "ring", "carrier")

    def planet_position(self, planet: int) -> tuple[float, float]:
        """Centre (x, y) [m] of planet `planet` (counted from 0) with the carrier at angle zero."""
        angle = self.planet_angles[planet]
        return self.carrier_radius * math.cos(angle), self.carrier_radius * math.sin(angle)
