"""Whether planets pass each other: the tip circles of neighbours must not touch.

The centres of two planets, an angle delta apart on the carrier, are 2 a sin(delta/2) apart, with
the centre distance a = m (Zs + Zp)/2; the tip diameter is m (Zp + 2 ha), with the addendum ha in
modules. Two opposite planets always pass: the sun between them has more than 2 ha teeth.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from .kinematics import Teeth


class Size(NamedTuple):
    """What decides how much room planets need."""

    teeth: Teeth
    module: float  # [m]
    addendum: float  # in modules

    @property
    def tip_diameter(self) -> float:
        """Of a planet [m]."""
        return self.module * (self.teeth.planet + 2.0 * self.addendum)

    def distance(self, angle: float) -> float:
        """Between the centres of two planets `angle` [rad] apart [m]."""
        return self.module * (self.teeth.sun + self.teeth.planet) * abs(math.sin(0.5 * angle))


def least_places(size: Size) -> int:
    """How many of the positions that can be assembled a planet is at least from the next."""
    places = size.teeth.sun + size.teeth.ring
    return next(n for n in range(1, places) if _clear(size, 2.0 * math.pi * n / places))


def most_planets(size: Size) -> int:
    """How many planets there is room for, as equally spaced as they can be assembled."""
    return (size.teeth.sun + size.teeth.ring) // least_places(size)


def are_clear(size: Size, angles: Sequence[float]) -> bool:
    """Whether planets at `angles` [rad] all pass each other."""
    first, second = _closest(size, angles)
    return _clear(size, angles[second] - angles[first])


def check_clearance(size: Size, angles: Sequence[float]) -> None:
    """Check that planets at `angles` [rad] pass each other.

    Raises:
        ValueError: the tip circles of two touch; names them, and how many planets there is room
            for where there are more.
    """
    if are_clear(size, angles):
        return
    first, second = _closest(size, angles)
    distance = round(1e3 * size.distance(angles[second] - angles[first]), 4)
    most = most_planets(size)
    room = f"; at most {most} planets fit, equally spaced" if len(angles) > most else ""
    raise ValueError(
        f"planet_angles = {', '.join(f'{math.degrees(angle):g}' for angle in angles)} deg: "
        f"planets {first + 1} and {second + 1} are {distance:.6g} mm apart, which must be more "
        f"than their tip diameter of {1e3 * size.tip_diameter:.6g} mm{room}"
    )


def _clear(size: Size, angle: float) -> bool:
    return size.distance(angle) > size.tip_diameter


def _closest(size: Size, angles: Sequence[float]) -> tuple[int, int]:
    """The two planets whose centres are closest."""
    pairs = ((i, j) for j in range(len(angles)) for i in range(j))
    return min(pairs, key=lambda pair: size.distance(angles[pair[1]] - angles[pair[0]]))
