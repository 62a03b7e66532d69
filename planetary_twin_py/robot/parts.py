"""The parts of a gearset as solids about their own axis, in metres; tooth 0 is at angle zero."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..gearset.involute import SpurGear
from ..gearset.solid import TriangleMesh, circle, extrude
from ..scene.gearset import Gearset

SUN, PLANET, RING, CARRIER, PIN, MARK = (
    (236, 176, 64),
    (92, 150, 214),
    (150, 158, 170),
    (176, 98, 84),
    (210, 214, 220),
    (250, 250, 250),  # of tooth 0, so that slow turning shows
)

_LAYER = 0.02  # [rad], largest twist of a layer of helical teeth


def sun(gearset: Gearset) -> TriangleMesh:
    """The sun: a toothed wheel with a bore for its shaft.

    Args:
        gearset: the gears.
    """
    return _wheel(gearset, gearset.geometry.sun, gearset.twist.sun, bore=0.3)


def planet(gearset: Gearset) -> TriangleMesh:
    """A planet: a toothed wheel with a bore for its pin.

    Args:
        gearset: the gears.
    """
    return _wheel(gearset, gearset.geometry.planet, gearset.twist.planet, bore=0.35)


def ring(gearset: Gearset) -> TriangleMesh:
    """The ring: an annulus with internal teeth.

    Args:
        gearset: the gears.
    """
    gear = gearset.geometry.ring
    return _toothed_rim(gear, rim(gear), 0.5 * gearset.face_width, gearset.twist.ring)


def pin(gearset: Gearset) -> TriangleMesh:
    """The pin of a planet, from the carrier through the planet.

    Args:
        gearset: the gears.
    """
    low, high = -0.7 * gearset.face_width, 0.56 * gearset.face_width
    return extrude(0.0, circle(pin_radius(gearset)), low, high)


def spider(gearset: Gearset) -> TriangleMesh:
    """The carrier: a plate behind the gears with one arm per planet.

    Args:
        gearset: the gears.
    """
    width, hub = arm_width(gearset), hub_radius(gearset)
    angles = np.linspace(0.0, 2.0 * math.pi, 720, endpoint=False)
    radius = np.full_like(angles, hub)
    for psi in gearset.planet_angles:
        radius = np.maximum(radius, _arm(angles - psi, carrier_radius(gearset), width))
    outline = np.column_stack((radius, angles))
    return extrude(0.5 * hub, outline, *plate(gearset))


def carrier_radius(gearset: Gearset) -> float:
    """Radius of the circle of the planet centres [m].

    Args:
        gearset: the gears.
    """
    return gearset.geometry.centre_distance


def rim(ring: SpurGear) -> float:
    """Outer radius of the ring [m]: its rim is two and a half modules thick."""
    return ring.root_radius + 2.5 * ring.module


def pin_radius(gearset: Gearset) -> float:
    """Radius of the pin in a planet [m].

    Args:
        gearset: the gears.
    """
    return 0.33 * gearset.geometry.planet.root_radius


def arm_width(gearset: Gearset) -> float:
    """Half the width of an arm of the carrier, and the radius of its end [m].

    Args:
        gearset: the gears.
    """
    return 0.6 * gearset.geometry.planet.root_radius


def hub_radius(gearset: Gearset) -> float:
    """Radius of the carrier's hub [m].

    Args:
        gearset: the gears.
    """
    return 0.9 * gearset.geometry.sun.root_radius


def plate(gearset: Gearset) -> tuple[float, float]:
    """Lower and upper z of the carrier's plate [m].

    Args:
        gearset: the gears.
    """
    return -0.72 * gearset.face_width, -0.54 * gearset.face_width


def _arm(angle: NDArray[np.float64], length: float, width: float) -> NDArray[np.float64]:
    """Polar outline of an arm with a round end, of half `width`, along angle zero."""
    across, along = np.abs(np.sin(angle)), np.cos(angle)
    end = length * along + np.sqrt(np.maximum(width**2 - (length * across) ** 2, 0.0))
    side = np.minimum(width / np.maximum(across, 1e-12), length)
    reach = np.where(length * across <= width, end, side)
    return np.where(along > 0.0, reach, 0.0)


def _wheel(gearset: Gearset, gear: SpurGear, twist: float, bore: float) -> TriangleMesh:
    """Teeth on a rim, a thinner web inside it, and a hub around the bore."""
    half = 0.5 * gearset.face_width
    root = gear.root_radius
    rim = max(root - 1.8 * gear.module, 0.7 * root)
    hub = min(1.35 * bore * root, 0.9 * rim)
    body = _toothed_rim(gear, rim, half, twist)
    body += extrude(bore * root, circle(hub), -half, half)
    return body + extrude(hub, circle(rim), -0.82 * half, 0.82 * half)


def _toothed_rim(gear: SpurGear, edge: float, half: float, twist: float) -> TriangleMesh:
    """The teeth, twisted if they are helical, and the plain rim between the root circle and radius
    `edge`."""
    outline = gear.outline()
    root = np.column_stack((np.full(len(outline), gear.root_radius), outline[:, 1]))
    layers = max(1, math.ceil(2.0 * half * abs(twist) / _LAYER))
    if gear.internal:
        teeth, plain = extrude(outline, root, -half, half, layers), extrude(root, edge, -half, half)
    else:
        teeth, plain = extrude(root, outline, -half, half, layers), extrude(edge, root, -half, half)
    return (teeth + plain).twisted(twist)
