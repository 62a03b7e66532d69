"""The frames of the gearset: parents and rotation angles.

Angles are the absolute angles of the bodies, as everywhere in this project. The base is therefore
the parent of sun, ring and carrier. The carrier moves a planet but must not rotate it: the parent
of a planet is the frame `planet_i_centre`, which is attached to the carrier and rotates by minus
the angle of the carrier. This is valid whichever member is fixed. Sensors with a place on the
housing have fixed frames on the rim of the ring, whose x axis is the axis of the sensor.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from ..scene.gearset import Gearset
from ..scene.sensors import Accelerometer, AnySensor, Proximity
from . import parts

PLACED = Accelerometer, Proximity
"""Sensors with a place on the housing."""


class Frame(NamedTuple):
    """A frame that rotates about z in its parent, by `sign` times the angle of `body`.

    Sign 0: it is fixed.
    """

    name: str
    parent: str
    body: str
    sign: int = 1
    at: tuple[float, float] = (0.0, 0.0)  # [m] in the parent
    turned: float = 0.0  # [rad] at angle 0


def frames(gearset: Gearset, base: str, sensors: Sequence[AnySensor] = ()) -> list[Frame]:
    """Frames of all bodies, of the planet centres and of sensors, parents first.

    Args:
        gearset: gives the planets and their positions.
        base: name of the root frame.
        sensors: those with an angle on the housing have frames.
    """
    members = [Frame(name, base, name) for name in ("sun", "ring", "carrier")]
    radius = parts.carrier_radius(gearset)
    planets = []
    for number, psi in enumerate(gearset.planet_angles, start=1):
        at = (radius * math.cos(psi), radius * math.sin(psi))
        planet, centre = f"planet_{number}", f"planet_{number}_centre"
        planets += [Frame(centre, "carrier", "carrier", -1, at), Frame(planet, centre, planet)]
    placed = [_sensor_frame(gearset, one, base) for one in sensors if isinstance(one, PLACED)]
    return members + planets + placed


def frame_of(sensor: AnySensor, base: str) -> str:
    """Name of the frame of a sensor: that of the gearbox unless it has a place on the housing.

    Args:
        sensor: the sensor.
        base: name of the root frame.
    """
    return f"sensor_{sensor.name}" if isinstance(sensor, PLACED) else base


def _sensor_frame(gearset: Gearset, sensor: Accelerometer | Proximity, base: str) -> Frame:
    radius, psi = parts.rim(gearset.geometry.ring), sensor.angle
    at = (radius * math.cos(psi), radius * math.sin(psi))
    across = isinstance(sensor, Accelerometer) and sensor.direction == "tangential"
    turned = psi + (0.5 * math.pi if across else 0.0)
    return Frame(frame_of(sensor, base), base, "ring", 0, at, turned)
