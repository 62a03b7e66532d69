"""Signal of a sensor on a gearbox, with the angle of its shaft."""

from __future__ import annotations

import numpy as np
from scipy.integrate import cumulative_trapezoid

from ...gearset.kinematics import MEMBERS
from ...model.layout import Layout
from ...recording.tables.sensor import Sensor
from ...scene import Scene
from ..sampling.even_steps import at_equal_steps, drift_remark, drifts, resampled
from ..sampling.interpolation import ERROR
from ..shaft.shaft_angle import Turned
from .signal import Array, Signal

INPUT = "input"


def sensor_signal(
    sensor: Sensor,
    scene: Scene | None,
    turned: Turned | None = None,
    shaft: str = INPUT,
) -> Signal:
    """Signal of a sensor.

    Args:
        sensor: its samples. A measured speed is that of `shaft`, and replaces that of the scene.
        scene: gears and speeds of the gearbox, which define mesh frequency and orders; None if they
            are unknown.
        turned: angle of `shaft` that was measured with times of its own; None without.
        shaft: "input", "output" or a member of the gear set.

    Returns:
        The signal at equal steps; samples whose stamps drift (see `drifts`) are interpolated, with
        a remark. Its angle is that of the sun relative to the carrier; without a scene that of the
        shaft whose speed is measured, or zero.

    Raises:
        ValueError: the shaft is not one of the scene, is at rest in it, or its speed does not
            define that of the input.
    """
    if turned is not None:
        remarks = sensor.remarks + turned.remarks
        part = turned.inside
        sensor = sensor._replace(
            time=sensor.time[part], samples=sensor.samples[part], remarks=remarks
        )
    angle = _angle(sensor, scene, turned, shaft)
    text = None if scene is None else scene.model_dump_json()
    samples, even, remarks = sensor.samples, at_equal_steps(sensor.time), sensor.remarks
    error = 0.0
    if drifts(sensor.time):
        samples, angle = resampled(samples, sensor.time), np.interp(even, sensor.time, angle)
        remarks += (drift_remark(sensor.time),)
        error = ERROR
    return Signal(samples, even, angle, text, remarks, error)


def _angle(sensor: Sensor, scene: Scene | None, turned: Turned | None, shaft: str) -> Array:
    """Of the sun relative to the carrier, or of the measured shaft without a scene [rad], (n,)."""
    elapsed = sensor.time - sensor.time[0]
    if turned is not None:
        angle = turned.angle
    elif sensor.speed is not None:
        angle = cumulative_trapezoid(sensor.speed, sensor.time, initial=0).astype(np.float64)
    elif scene is not None:
        return _relative_sun(scene, scene.operating_point.input_speed * elapsed, elapsed, INPUT)
    else:
        return np.zeros(len(elapsed))
    return angle if scene is None else _relative_sun(scene, angle, elapsed, shaft)


def _relative_sun(scene: Scene, angle: Array, elapsed: Array, shaft: str) -> Array:
    """Angle of the sun relative to the carrier [rad], (n,).

    Args:
        scene: gears, and the speed of a second input.
        angle: of a shaft [rad], (n,).
        elapsed: time since the first sample [s], (n,).
        shaft: its name.
    """
    of_input = input_angle(scene, angle, elapsed, shaft)
    ratios, second = Layout(scene).ratios, scene.operating_point.second_input_speed
    pairs = zip(ratios["sun"], ratios["carrier"], strict=True)
    of_first, *of_second = (float(sun - carrier) for sun, carrier in pairs)
    return np.asarray(of_first * of_input + sum(of_second) * second * elapsed)


def input_angle(scene: Scene, angle: Array, elapsed: Array, shaft: str) -> Array:
    """Angle of the input shaft [rad], (n,).

    Args:
        scene: gears, and the speed of a second input.
        angle: of a shaft [rad], (n,).
        elapsed: time since the first sample [s], (n,).
        shaft: "input", "output" or a member of the gear set.

    Raises:
        ValueError: there is no such shaft, or it is at rest in the scene.
    """
    ratios, second = Layout(scene).ratios, scene.operating_point.second_input_speed
    machines = {INPUT: scene.drive.input.member, "output": scene.drive.output.member}
    member = machines.get(shaft, shaft)
    if member not in MEMBERS:
        raise ValueError(f"shaft = {shaft!r}: must be input, output, {', '.join(MEMBERS)}")
    own, *own_of_second = (float(one) for one in ratios[member])
    if own == 0.0:
        raise ValueError(f"shaft = {shaft!r}: is at rest in this scene")
    return np.asarray((angle - sum(own_of_second) * second * elapsed) / own)
