"""Film and friction of one tooth pair by the laws of a scene, at the pitch point or sliding."""

from __future__ import annotations

import math
from typing import NamedTuple

from ..dynamics.oil import build_oil
from ..dynamics.static_load import mesh_force
from ..dynamics.tooth_contact import choices, lambda_ratio_of, tooth_contact
from ..gearset.geometry import pitch_radius
from ..scene import Scene

SUN, RING = 0, 1  # kinds of mesh
KINDS = ("sun-planet", "planet-ring")


class Contact(NamedTuple):
    """What the laws of the oil give for one pair of flanks."""

    friction: float  # signed [N]
    boundary: float  # [N]
    viscous: float  # [N]
    film: float  # [m]
    lambda_ratio: float
    sliding: float  # [m/s]
    slope: float  # of friction over sliding [N s/m]
    rolling: float  # resistance [N]


def static_load(scene: Scene) -> float:
    """Mean force of one mesh without friction [N]."""
    return abs(mesh_force(scene, scene.operating_point.input_torque))


def at_pitch_point(scene: Scene, kind: int) -> Contact:
    """One pair that carries the whole mean force, at the scene's speed, carrier held."""
    gearset = scene.gearset
    teeth, sine = gearset.tooth_numbers, math.sin(gearset.pressure_angle)
    first, second = ((teeth.sun, teeth.planet), (teeth.planet, teeth.ring))[kind]
    external = 1.0 if kind == SUN else -1.0
    speed = external * scene.operating_point.input_speed * teeth.sun / first
    return contact(
        scene,
        (pitch_radius(first, gearset.module) * sine, pitch_radius(second, gearset.module) * sine),
        (speed, -external * speed * first / second),
        external,
    )


def contact(
    scene: Scene, curvature: tuple[float, float], speed: tuple[float, float], external: float
) -> Contact:
    """Flanks of given radii [m] and speeds [rad/s] under the mean mesh force."""
    point = scene.operating_point
    oil = build_oil(scene, point)
    pair = (*curvature, external, *speed, static_load(scene))
    signed, boundary, viscous, log_film, sliding, slope, rolling, _ = tooth_contact(
        oil, choices(oil), pair
    )
    ratio = lambda_ratio_of(oil, oil.prescribed, log_film)
    film = math.exp(log_film)
    return Contact(signed, boundary, viscous, film, ratio, sliding, slope, rolling)
