"""Samples of an accelerometer of a plant.

It measures the acceleration of the transmission error along the line of action, behind a path with
another gain and phase at each mesh harmonic and the sidebands around it. A filter in front of the
sampling removes what the sample rate does not resolve.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..scene.quantity import quantity
from ..sensors.filters import PASSED
from .device import Array, Chunk, DeviceErrors, MeasuredPlant, SimulatedDevice
from .pattern import POINTS, Pattern, course_of

NAME = "acceleration"


class Accelerometer(DeviceErrors):
    """An accelerometer behind a path from the teeth that differs between harmonics."""

    noise: float = quantity("m/s^2", "standard deviation of a sample", 0.5, ge=0.0, le=1e6)
    path: float = quantity(
        "", "largest factor by which the path amplifies or attenuates a mesh harmonic", 3.0,
        ge=1.0, le=1e3,
    )  # fmt: skip


def accelerometer(
    plant: MeasuredPlant, sensor: Accelerometer, chance: np.random.Generator
) -> Callable[[Chunk], Array]:
    """Function of some samples that returns accelerations [m/s^2], (n, 1)."""
    per_turn = abs(float(plant.train.cycles)) / (2.0 * math.pi)  # mesh cycles per radian
    fastest = float(np.max(np.abs(plant.course.speed)))
    highest = PASSED * sensor.rate / (per_turn * fastest)  # mesh order that is never an alias
    path = _path(sensor, highest, chance)
    stages = tuple(
        stage._replace(pattern=_curvature(stage.pattern, path, highest))
        for stage in plant.error_stages
    )

    def read(chunk: Chunk) -> Array:
        curvature = course_of(stages, chunk.time, chunk.cycles, chunk.torque)
        values = curvature * (per_turn * plant.course.speed_at(chunk.time)) ** 2
        values += sensor.noise * chance.standard_normal(len(chunk.time))
        return values[:, None]

    return read


def _path(sensor: Accelerometer, highest: float, chance: np.random.Generator) -> NDArray[Any]:
    """Complex gain of the path at the mesh harmonics around orders up to one, from 0 on."""
    harmonics = round(highest) + 1
    reach = math.log(sensor.path)
    gain = np.exp(chance.uniform(-reach, reach, harmonics))
    return np.asarray(gain * np.exp(2.0j * math.pi * chance.random(harmonics)))


def _curvature(pattern: Pattern, path: NDArray[Any], highest: float) -> Pattern:
    """Second derivative of a pattern over the mesh cycles, behind the path, up to an order."""
    count = pattern.values.shape[1]
    order = np.arange(count // 2 + 1) * (POINTS / count)
    gain = np.zeros(len(order), dtype=np.complex128)
    passed = order <= highest
    gain[passed] = path[np.round(order[passed]).astype(int)]
    gain *= -((2.0 * math.pi * order) ** 2)
    spectrum = np.fft.rfft(pattern.values, axis=1) * gain
    return Pattern(pattern.torques, np.fft.irfft(spectrum, count, axis=1))


DEVICE = SimulatedDevice(Accelerometer, {NAME: "m/s^2"}, accelerometer, 3)
