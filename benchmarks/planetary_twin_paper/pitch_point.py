"""Film and friction of one tooth pair by the laws of a scene."""

from __future__ import annotations

import math
from typing import NamedTuple

from planetary_twin_py._core import lambda_ratio_of, tooth_contact
from planetary_twin_py.gearset.geometry import pitch_radius
from planetary_twin_py.model.layout import Layout
from planetary_twin_py.model.oil import build_oil
from planetary_twin_py.scene import Scene

SUN, RING = 0, 1  # kinds of mesh
KINDS = ("sun-planet", "planet-ring")


class Contact(NamedTuple):
    """Film and friction of one pair of flanks."""

    friction: float
    """With the sign of the sliding speed [N]."""
    boundary: float
    """Boundary friction [N]."""
    viscous: float
    """Viscous friction [N]."""
    film: float
    """Film thickness [m]."""
    lambda_ratio: float
    sliding: float
    """Sliding speed [m/s]."""
    slope: float
    """Derivative of friction with respect to sliding speed [N s/m]."""
    rolling: float
    """Rolling resistance [N]."""


def static_load(scene: Scene) -> float:
    """Mean force of one mesh without friction [N].

    Args:
        scene: at its operating point.
    """
    return abs(Layout(scene).mesh_force(scene.operating_point.input_torque))


def at_pitch_point(scene: Scene, kind: int) -> Contact:
    """Contact of one pair that carries the mean mesh force, with the carrier held.

    Args:
        scene: at its operating point.
        kind: `SUN` or `RING`.

    Returns:
        Film and friction.
    """
    gearset = scene.gearset
    teeth, sine = gearset.tooth_numbers, math.sin(gearset.transverse.pressure_angle)
    first, second = ((teeth.sun, teeth.planet), (teeth.planet, teeth.ring))[kind]
    external = 1.0 if kind == SUN else -1.0
    speed = external * scene.operating_point.input_speed * teeth.sun / first
    return contact(
        scene,
        (
            pitch_radius(first, gearset.transverse.module) * sine,
            pitch_radius(second, gearset.transverse.module) * sine,
        ),
        (speed, -external * speed * first / second),
        external,
    )


def contact(
    scene: Scene, curvature: tuple[float, float], speed: tuple[float, float], external: float
) -> Contact:
    """Contact of two flanks under the mean mesh force.

    Args:
        scene: at its operating point.
        curvature: radii of curvature of both flanks [m].
        speed: of both gears relative to the carrier [rad/s].
        external: 1 for two external gears, -1 with an internal gear.

    Returns:
        Film and friction.
    """
    point = scene.operating_point
    oil = build_oil(scene, point)
    pair = (*curvature, external, *speed, static_load(scene))
    signed, boundary, viscous, log_film, sliding, slope, rolling, _ = tooth_contact(oil, pair)
    ratio = lambda_ratio_of(oil, log_film)
    film = math.exp(log_film)
    return Contact(signed, boundary, viscous, film, ratio, sliding, slope, rolling)
