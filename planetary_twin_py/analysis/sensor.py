"""Signal of a sensor on a gearbox, with the angles of a scene at constant speed."""

from __future__ import annotations

import numpy as np

from ..dynamics.bodies import rigid_ratios
from ..recording.tables.sensor import Sensor
from ..scene import Scene
from .signals import Signal


def sensor_signal(sensor: Sensor, scene: Scene | None) -> Signal:
    """Signal of a sensor.

    Args:
        sensor: uniformly spaced samples.
        scene: gears and speeds of the gearbox, which define mesh frequency and orders; None if they
            are unknown.

    Returns:
        The signal; without a scene its angle is zero.
    """
    speed = 0.0 if scene is None else _relative_sun_speed(scene)
    angle = speed * (sensor.time - sensor.time[:1])
    text = None if scene is None else scene.model_dump_json()
    return Signal(sensor.samples, sensor.time, angle, text)


def _relative_sun_speed(scene: Scene) -> float:
    """Speed [rad/s] of the sun relative to the carrier at the operating point."""
    ratios, point = rigid_ratios(scene), scene.operating_point
    pairs = zip(ratios["sun"], ratios["carrier"], strict=True)
    per_input = np.array([float(sun - carrier) for sun, carrier in pairs])
    inputs = (point.input_speed, point.second_input_speed)[: len(per_input)]
    return float(per_input @ inputs)
