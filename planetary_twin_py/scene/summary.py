"""A scene in two lines, in the units that engineers use: a wrong unit shows here first."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..units import customary
from .scene import Scene


def summary(scene: Scene) -> Iterator[str]:
    """The gears and the operating point of a scene.

    Args:
        scene: to describe.

    Yields:
        A line for each of them.
    """
    gearset, point = scene.gearset, scene.operating_point
    teeth = gearset.teeth
    positions = ", ".join(f"{math.degrees(angle):.4g}" for angle in gearset.planet_angles)
    lengths = (
        f"{name} {customary(value, 'm')}"
        for name, value in (("module", gearset.module), ("face width", gearset.face_width))
    )
    angles = [f"pressure angle {customary(gearset.pressure_angle, 'rad')}"]
    if gearset.helix_angle:
        angles.append(f"helix angle {customary(gearset.helix_angle, 'rad')}")
    yield (
        f"gears: {teeth.sun}/{teeth.planet}/{teeth.ring} teeth, {', '.join(lengths)}, "
        f"{', '.join(angles)}, planets at {positions} deg, {gearset.held} held"
    )
    inputs = (point.input_speed, point.second_input_speed)[: len(scene.drive.inputs)]
    speeds = " and ".join(customary(speed, "rad/s") for speed in inputs)
    yield (
        f"operating point: input speed {speeds}, input torque {point.input_torque:.4g} N m, "
        f"backlash {customary(point.backlash, 'm')}, oil {customary(point.oil_temperature, 'K')}"
    )
