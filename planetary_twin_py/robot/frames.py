"""The frames of the gearset: parents and rotation angles.

Angles are the absolute angles of the bodies, as everywhere in this project. The base is therefore
the parent of sun, ring and carrier. The carrier moves a planet but must not rotate it: the parent
of a planet is the frame `planet_i_centre`, which is attached to the carrier and rotates by minus
the angle of the carrier. This is valid whichever member is fixed.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ..scene.gearset import Gearset
from . import parts


class Frame(NamedTuple):
    """A frame that rotates about z in its parent, by `sign` times the angle of `body`."""

    name: str
    parent: str
    body: str
    sign: int = 1
    at: tuple[float, float] = (0.0, 0.0)  # [m] in the parent


def frames(gearset: Gearset, base: str) -> list[Frame]:
    """Frames of all bodies and of the planet centres, parents first.

    Args:
        gearset: gives the planets and their positions.
        base: name of the root frame.
    """
    members = [Frame(name, base, name) for name in ("sun", "ring", "carrier")]
    radius = parts.carrier_radius(gearset)
    planets = []
    for number, psi in enumerate(gearset.planet_angles, start=1):
        at = (radius * math.cos(psi), radius * math.sin(psi))
        planet, centre = f"planet_{number}", f"planet_{number}_centre"
        planets += [Frame(centre, "carrier", "carrier", -1, at), Frame(planet, centre, planet)]
    return members + planets
