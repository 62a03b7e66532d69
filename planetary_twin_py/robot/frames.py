"""The frames of the gearset: what turns on what, and by which angle.

Angles are the absolute angles of the bodies, as everywhere in this project. Sun, ring and carrier
therefore hang on the base. A planet is carried round, yet must not be turned, by the carrier: it
hangs on a frame `planet_i_centre` that stands on the carrier and turns back by the carrier's angle.
This holds whichever member is held, and nothing but the absolute angles is needed.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ..scene.gearset import Gearset
from . import parts


class Frame(NamedTuple):
    """A frame that turns about z on its parent, by the angle of a body or against it."""

    name: str
    parent: str
    body: str
    sign: int = 1
    at: tuple[float, float] = (0.0, 0.0)  # [m] in the parent


def frames(gearset: Gearset, base: str) -> list[Frame]:
    """Frames on `base`, parents first: one of each body's name, and the planets' centres."""
    members = [Frame(name, base, name) for name in ("sun", "ring", "carrier")]
    radius = parts.carrier_radius(gearset)
    planets = []
    for number, psi in enumerate(gearset.planet_angles, start=1):
        at = (radius * math.cos(psi), radius * math.sin(psi))
        planet, centre = f"planet_{number}", f"planet_{number}_centre"
        planets += [Frame(centre, "carrier", "carrier", -1, at), Frame(planet, centre, planet)]
    return members + planets
