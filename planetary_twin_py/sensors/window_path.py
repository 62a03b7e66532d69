"""Alternating forces of the ring meshes, weighted by a window of the angle to the sensor."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..scene.sensors.accelerometer import Accelerometer
from ..scene.sensors.paths import FilteredWindow, ResolvedWindow, WindowShape
from .filters import UNCHANGED
from .high_pass import HighPass
from .path import SensorInput, planet_places, ring_force
from .path_response import path_response
from .reader import Sampling
from .sensed import Sensed
from .windows import window

CUT_OFF = 0.5  # [Hz], of the alternating part of a force

Array = NDArray[np.float64]


def window_path(samples: Sampling, sensor: Accelerometer, path: WindowShape) -> SensorInput:
    """What an accelerometer receives through a window.

    Args:
        samples: from which the sensor reads.
        sensor: the sensor.
        path: its path.

    Returns:
        One signal.
    """
    layout, planets = samples.layout, samples.layout.scene.gearset.planets
    across = sensor.direction == "tangential"
    angle = layout.scene.gearset.geometry.meshes[1].pressure_angle
    alternating = _alternating(samples, isinstance(path, ResolvedWindow))

    def signals(sensed: Sensed) -> list[Array]:
        distance = planet_places(layout, sensed) - sensor.angle
        force = alternating(ring_force(layout, sensed))
        if isinstance(path, ResolvedWindow):
            force = along_axis(force[:, planets:], force[:, :planets], distance, angle, across)
        weighted = force * window(path, planets, distance)
        return [path.gain * weighted.sum(axis=1)]

    response = path_response(path) if isinstance(path, FilteredWindow) else UNCHANGED
    return SensorInput(signals, (response,))


def _alternating(samples: Sampling, magnitudes: bool) -> Callable[[Array], Array]:
    """What makes the alternating part of forces, and, behind them, of their `magnitudes`."""
    gearset, point = samples.layout.scene.gearset, samples.layout.scene.operating_point
    static = np.full(gearset.planets, samples.layout.mesh_force(point.input_torque))
    mean = static if samples.mean_force is None else samples.mean_force

    def beside(force: Array) -> Array:
        return np.concatenate([force, np.abs(force)], axis=-1) if magnitudes else force

    if samples.mean_force is None:
        high_pass = HighPass(CUT_OFF, samples.rate, beside(mean))
        return lambda force: high_pass.take(beside(force))
    return lambda force: beside(force) - beside(mean)


def along_axis(
    pressing: Array, turning: Array, distance: Array, pressure_angle: float, across: bool
) -> Array:
    """Part of the forces on the ring that acts along the axis of a sensor.

    Args:
        pressing: magnitudes of the forces of the ring meshes [N], (samples, planets).
        turning: the forces, negative on coast flanks [N], (samples, planets).
        distance: angle from the sensor to each planet [rad], (samples, planets).
        pressure_angle: working one of the ring meshes [rad].
        across: whether the axis is tangential, counter-clockwise, instead of outwards.

    Returns:
        Forces [N], (samples, planets).
    """
    # Teeth press outwards; those of drive flanks turn the ring clockwise if the sun drives.
    radial, tangential = pressing * math.sin(pressure_angle), -turning * math.cos(pressure_angle)
    sine, cosine = np.sin(distance), np.cos(distance)
    if across:
        return np.asarray(radial * sine + tangential * cosine)
    return np.asarray(radial * cosine - tangential * sine)
