"""Shape of involute spur gears, external and internal.

The flanks are true involutes of the base circle r cos(alpha); the tooth fills half the pitch on
the pitch circle (no profile shift, no backlash), dedendum 1.25 modules. The root is simplified:
where the root circle lies inside the base circle, a radial line joins the start of the involute to
the root circle in place of the trochoid that a hob would cut.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .geometry import pitch_radius

DEDENDUM = 1.25  # of the module
_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class SpurGear:
    """A standard spur gear: `module` [m], `pressure_angle` [rad], `addendum` [modules].

    The teeth of an internal gear point inwards.

    Raises:
        ValueError: the teeth would be pointed, or an internal tip lies inside its base circle.
    """

    teeth: int
    module: float
    pressure_angle: float
    addendum: float = 1.0
    internal: bool = False

    def __post_init__(self) -> None:
        if self.internal and self.tip_radius <= self.base_radius:
            raise ValueError(f"teeth = {self.teeth}: the ring's tips lie inside its base circle")
        if self.half_thickness(np.array(self.tip_radius)) <= 0.0:
            raise ValueError(f"teeth = {self.teeth}: the tooth is pointed below its tip circle")

    @property
    def pitch_radius(self) -> float:
        """Radius of the pitch circle [m]."""
        return pitch_radius(self.teeth, self.module)

    @property
    def base_radius(self) -> float:
        """Radius of the base circle, where the involute begins [m]."""
        return self.pitch_radius * math.cos(self.pressure_angle)

    @property
    def tip_radius(self) -> float:
        """Radius of the tip circle [m]."""
        height = self.addendum * self.module
        return self.pitch_radius + (-height if self.internal else height)

    @property
    def root_radius(self) -> float:
        """Radius of the root circle [m]."""
        depth = DEDENDUM * self.module
        return self.pitch_radius + (depth if self.internal else -depth)

    def half_thickness(self, radius: NDArray[np.float64]) -> NDArray[np.float64]:
        """Half the angle [rad] that a tooth spans on circles of `radius` [m], any shape."""
        local = np.arccos(np.minimum(self.base_radius / radius, 1.0))
        thinning = _involute(local) - _involute(np.array(self.pressure_angle))
        return 0.5 * math.pi / self.teeth + (thinning if self.internal else -thinning)

    def tooth(self, points: int = 9) -> NDArray[np.float64]:
        """One tooth and the root land after it, as polar points (radius [m], angle [rad]).

        The tooth is centred on angle zero, the points run counter-clockwise, shape (k, 2);
        `points` counts those on each flank.
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
        """The whole gear, once around counter-clockwise, as polar points like those of `tooth`."""
        tooth = self.tooth(points)
        outline = np.tile(tooth, (self.teeth, 1))
        outline[:, 1] += np.repeat(_TURN / self.teeth * np.arange(self.teeth), len(tooth))
        return outline


def _involute(angle: NDArray[np.float64]) -> NDArray[np.float64]:
    """Involute function tan(a) - a [rad]."""
    return np.tan(angle) - angle
