"""Clearance between neighbouring planets: their tip circles must not touch.

The centres of two planets with an angle delta between them have the distance 2 a sin(delta/2),
where a is the centre distance, m (Zs + Zp)/2 of gears without profile shift. Their tip diameter is
then m (Zp + 2 ha), where ha is the addendum in modules.
Two opposite planets are always clear, because the sun has more than 2 ha teeth.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from .kinematics import Teeth


class Size(NamedTuple):
    """Dimensions that determine the space planets require."""

    teeth: Teeth
    module: float
    """[m]"""
    addendum: float
    """[modules]"""
    centre_distance: float | None = None
    """Of sun and planets [m]; default: that of gears without profile shift."""
    planet_tip: float | None = None
    """Tip diameter of a planet [m]; default: that of a gear without profile shift."""

    @property
    def tip_diameter(self) -> float:
        """Tip diameter of a planet [m]."""
        if self.planet_tip is not None:
            return self.planet_tip
        return self.module * (self.teeth.planet + 2.0 * self.addendum)

    def distance(self, angle: float) -> float:
        """Distance between the centres of two planets [m].

        Args:
            angle: between the planets [rad].
        """
        if self.centre_distance is not None:
            return 2.0 * self.centre_distance * abs(math.sin(0.5 * angle))
        return self.module * (self.teeth.sun + self.teeth.planet) * abs(math.sin(0.5 * angle))


def least_places(size: Size) -> int:
    """Smallest distance between planets, in positions at which a planet can be assembled.

    Args:
        size: dimensions of the gearset.
    """
    places = size.teeth.sun + size.teeth.ring
    return next(n for n in range(1, places) if _clear(size, 2.0 * math.pi * n / places))


def most_planets(size: Size) -> int:
    """Largest number of planets, spaced as equally as assembly permits.

    Args:
        size: dimensions of the gearset.
    """
    return (size.teeth.sun + size.teeth.ring) // least_places(size)


def are_clear(size: Size, angles: Sequence[float]) -> bool:
    """Whether no tip circles of planets touch.

    Args:
        size: dimensions of the gearset.
        angles: positions of the planets [rad].
    """
    first, second = _closest(size, angles)
    return _clear(size, angles[second] - angles[first])


def check_clearance(size: Size, angles: Sequence[float]) -> None:
    """Check that no tip circles of planets touch.

    Args:
        size: dimensions of the gearset.
        angles: positions of the planets [rad].

    Raises:
        ValueError: the tip circles of two planets touch; the message names them, and the largest
            number of planets if there are more.
    """
    if are_clear(size, angles):
        return
    first, second = _closest(size, angles)
    distance = round(1e3 * size.distance(angles[second] - angles[first]), 4)
    most = most_planets(size)
    room = f"; at most {most} planets fit, equally spaced" if len(angles) > most else ""
    raise ValueError(
        f"planet_angles = {', '.join(f'{math.degrees(angle):g}' for angle in angles)} deg: "
        f"the distance of planets {first + 1} and {second + 1} is {distance:.6g} mm and must be "
        f"above their tip diameter of {1e3 * size.tip_diameter:.6g} mm{room}"
    )


def _clear(size: Size, angle: float) -> bool:
    return size.distance(angle) > size.tip_diameter


def _closest(size: Size, angles: Sequence[float]) -> tuple[int, int]:
    """The two planets whose centres are closest."""
    pairs = ((i, j) for j in range(len(angles)) for i in range(j))
    return min(pairs, key=lambda pair: size.distance(angles[pair[1]] - angles[pair[0]]))
