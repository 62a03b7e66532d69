"""Film and friction of one tooth pair at the pitch point, by the laws of a scene."""

from __future__ import annotations

import math
from typing import NamedTuple

from ..dynamics.oil import build_oil
from ..dynamics.static_load import mesh_force
from ..dynamics.tooth_contact import tooth_contact
from ..gearset.geometry import pitch_radius
from ..scene import Scene

SUN, RING = 0, 1  # kinds of mesh
KINDS = ("sun-planet", "planet-ring")


class ToothPair(NamedTuple):
    """What the laws of the oil give at the pitch point."""

    load: float  # [N]
    boundary: float  # [N]
    viscous: float  # [N]
    film: float  # [m]
    lambda_ratio: float


def static_load(scene: Scene) -> float:
    """Mean force of one mesh without friction [N]: T/(planets r_b) at the sun."""
    return abs(mesh_force(scene, scene.operating_point.input_torque))


def at_pitch_point(scene: Scene, kind: int, load: float | None = None) -> ToothPair:
    """One pair that carries `load` [N], by default the whole mean force, at the scene's speed."""
    gearset, point = scene.gearset, scene.operating_point
    load = static_load(scene) if load is None else load
    teeth = gearset.tooth_numbers
    sine = math.sin(gearset.pressure_angle)
    first, second = ((teeth.sun, teeth.planet), (teeth.planet, teeth.ring))[kind]
    speed = point.input_speed * teeth.sun / first * (1.0 if kind == SUN else -1.0)
    external = 1.0 if kind == SUN else -1.0
    _, boundary, viscous, film, ratio, _, _ = tooth_contact(
        build_oil(scene),
        pitch_radius(first, gearset.module) * sine,
        pitch_radius(second, gearset.module) * sine,
        external,
        speed,
        -external * speed * first / second,
        load,
        point.lambda_ratio,
    )
    return ToothPair(load, boundary, viscous, film, ratio)
