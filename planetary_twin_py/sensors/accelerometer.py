"""An accelerometer on the housing."""

from __future__ import annotations

import math

import numpy as np

from ..scene.sensors.accelerometer import Accelerometer
from ..scene.sensors.paths import FlexibleRing, RigidRing
from .converter import Converter, ErrorModel
from .filtered import Filtered
from .filters import UNCHANGED, Response
from .flexible_path import flexible_path
from .high_pass import HighPass
from .mode import Mode
from .noise import Noise
from .path import Heard
from .reader import Sampling, empty_readings
from .rigid_path import rigid_path
from .window_path import window_path


def accelerometer(sensor: Accelerometer, samples: Sampling) -> Filtered:
    """Make what reads an accelerometer.

    Args:
        sensor: the sensor.
        samples: from which it reads.
    """
    errors = ErrorModel(sensor.noise, 0.0, 0.0)
    high_pass = sensor.high_pass
    return Filtered(
        empty_readings(sensor, sensor.kind, "m/s^2", sensor.rate),
        _heard(sensor, samples),
        _own_response(sensor),
        samples.rate,
        samples.first,
        Converter(errors, Noise(sensor.seed, sensor.name), sensor.range, sensor.bits),
        HighPass(high_pass, sensor.rate, np.zeros(1)) if high_pass else None,
    )


def _heard(sensor: Accelerometer, samples: Sampling) -> Heard:
    path = sensor.path
    if isinstance(path, FlexibleRing):
        return flexible_path(samples.layout, sensor, path)
    if isinstance(path, RigidRing):
        return rigid_path(samples.layout, sensor, path)
    return window_path(samples, sensor, path)


def _own_response(sensor: Accelerometer) -> Response:
    if sensor.resonance is None:
        return UNCHANGED
    mode = Mode(math.tau * sensor.resonance, sensor.damping_ratio)
    return Response(mode.displacement, (mode,))
