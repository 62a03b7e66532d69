"""Signal of a sensor on a gearbox, with the angle of its shaft."""

from __future__ import annotations

import numpy as np
from scipy.integrate import cumulative_trapezoid

from ..model.layout import Layout
from ..recording.tables.sensor import Sensor
from ..scene import Scene
from .even_steps import at_equal_steps, drift_remark, drifts, resampled
from .interpolation import ERROR
from .signals import Array, Signal


def sensor_signal(sensor: Sensor, scene: Scene | None) -> Signal:
    """Signal of a sensor.

    Args:
        sensor: its samples. A measured speed is that of the input shaft, and replaces that of the
            scene.
        scene: gears and speeds of the gearbox, which define mesh frequency and orders; None if they
            are unknown.

    Returns:
        The signal at equal steps; samples whose stamps drift (see `drifts`) are interpolated, with
        a remark. Its angle is that of the sun relative to the carrier; without a scene that of the
        shaft whose speed is measured, or zero.
    """
    speed = np.zeros(len(sensor.time))
    if sensor.speed is not None:
        speed = sensor.speed
    elif scene is not None:
        speed += scene.operating_point.input_speed
    if scene is not None:
        speed = _relative_sun_speed(scene, speed)
    angle = cumulative_trapezoid(speed, sensor.time, initial=0).astype(np.float64)
    text = None if scene is None else scene.model_dump_json()
    samples, even, remarks = sensor.samples, at_equal_steps(sensor.time), sensor.remarks
    error = 0.0
    if drifts(sensor.time):
        samples, angle = resampled(samples, sensor.time), np.interp(even, sensor.time, angle)
        remarks += (drift_remark(sensor.time),)
        error = ERROR
    return Signal(samples, even, angle, text, remarks, error)


def _relative_sun_speed(scene: Scene, input_speed: Array) -> Array:
    """Speed of the sun relative to the carrier [rad/s], (n,).

    Args:
        scene: gears, and the speed of a second input.
        input_speed: of the input shaft [rad/s], (n,).
    """
    ratios, second = Layout(scene).ratios, scene.operating_point.second_input_speed
    pairs = zip(ratios["sun"], ratios["carrier"], strict=True)
    of_input, *of_second = (float(sun - carrier) for sun, carrier in pairs)
    return of_input * input_speed + sum(of_second) * second
