"""Flash temperature: rise of the surfaces of teeth above their gears, where they rub.

Heat of friction enters both surfaces over the Hertzian contact, which moves quickly over each of
them, so it spreads only inwards (Blok 1937, 1963; Jaeger 1942).
"""

from __future__ import annotations

import math
import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..text.warning_types import AccuracyWarning

# Highest temperature under a semi-elliptic source of heat: max over x of the integral from -1 to x
# of sqrt(1 - s^2)/sqrt(x - s), times 4/pi/sqrt(2 pi).
HERTZ = 1.1115
LEAST_PECLET = 5.0  # below, the rise is too high by more than 0.3 %


class Solid(NamedTuple):
    """Thermal properties of a gear."""

    conductivity: float
    """[W/(m K)]"""
    density: float
    """[kg/m^3]"""
    heat_capacity: float
    """[J/(kg K)]"""

    @property
    def contact_coefficient(self) -> float:
        """Effusivity B = sqrt(conductivity density heat_capacity) [W s^0.5/(m^2 K)]."""
        return math.sqrt(self.conductivity * self.density * self.heat_capacity)

    def peclet(
        self, speed: NDArray[np.float64], half_width: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Peclet number of a contact that moves over the surface, V b/(2 diffusivity), (...)."""
        capacity = self.density * self.heat_capacity
        return np.abs(speed) * half_width * capacity / (2.0 * self.conductivity)


def flash_temperature(
    friction: ArrayLike,
    speed1: ArrayLike,
    speed2: ArrayLike,
    half_width: ArrayLike,
    solid1: Solid,
    solid2: Solid,
) -> NDArray[np.float64]:
    """Highest flash temperature of a line contact.

    The heat is divided so that both surfaces are equally hot.

    Args:
        friction: friction force over face width [N/m], (...).
        speed1: speed of the first surface relative to the contact [m/s], (...).
        speed2: that of the second surface [m/s], (...).
        half_width: half the width of the Hertzian contact [m], above 0, (...).
        solid1: first body.
        solid2: second body.

    Returns:
        k f |V1 - V2|/((B1 sqrt V1 + B2 sqrt V2) sqrt(2 b)), k = 1.1115 [K] (Blok 1963), (...);
        0 without sliding.

    Raises:
        ValueError: a half width is not above 0.

    Warns:
        AccuracyWarning: a surface that rubs is so slow that heat spreads along it as well: there
            the flash temperature is lower than this.
    """
    force, first, second, width = np.broadcast_arrays(
        *(np.asarray(value, dtype=np.float64) for value in (friction, speed1, speed2, half_width))
    )
    if (wrong := width[~(width > 0.0)]).size:
        raise ValueError(f"half_width = {wrong.flat[0]!r} m: must be above 0")
    sliding = np.abs(first - second)
    slow = np.minimum(solid1.peclet(first, width), solid2.peclet(second, width)) < LEAST_PECLET
    if np.any(slow & (sliding * force != 0.0)):
        warnings.warn(
            f"a Peclet number is below {LEAST_PECLET:g}: the flash temperature is too high there",
            AccuracyWarning,
            stacklevel=2,
        )
    carried = solid1.contact_coefficient * np.sqrt(np.abs(first))
    carried = carried + solid2.contact_coefficient * np.sqrt(np.abs(second))
    heat = HERTZ * np.abs(force) * sliding
    return np.divide(
        heat, carried * np.sqrt(2.0 * width), out=np.zeros(np.shape(heat)), where=heat > 0.0
    )
