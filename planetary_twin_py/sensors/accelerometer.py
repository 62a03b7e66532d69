"""An accelerometer on the housing."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..scene.sensors.accelerometer import Accelerometer
from ..scene.sensors.paths import FlexibleRing, RigidRing
from .converter import Converter, ErrorModel
from .filtered import Filtered
from .filters import UNCHANGED, Response
from .flexible_path import flexible_path
from .high_pass import HighPass
from .mode import Mode
from .noise import Noise
from .path import SensorInput
from .reader import Sampling, empty_readings
from .rigid_path import rigid_path
from .sensed import Sensed
from .window_path import window_path

Array = NDArray[np.float64]


def accelerometer(
    sensor: Accelerometer, samples: Sampling, shift: Callable[[Array], Array] | None = None
) -> Filtered:
    """Make what reads an accelerometer.

    Args:
        sensor: the sensor.
        samples: from which it reads.
        shift: factor on all signals by the numbers of the samples, which shifts their frequencies.
    """
    errors = ErrorModel(sensor.noise, 0.0, 0.0)
    received, high_pass = _input(sensor, samples), sensor.high_pass
    return Filtered(
        empty_readings(sensor, sensor.kind, "m/s^2", sensor.rate),
        received if shift is None else _shifted(received, shift),
        _own_response(sensor),
        samples.rate,
        samples.first,
        Converter(errors, Noise(sensor.seed, sensor.name), sensor.range, sensor.bits),
        HighPass(high_pass, sensor.rate, np.zeros(1)) if high_pass else None,
    )


def _input(sensor: Accelerometer, samples: Sampling) -> SensorInput:
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


def _shifted(received: SensorInput, shift: Callable[[Array], Array]) -> SensorInput:
    def signals(sensed: Sensed) -> list[Array]:
        factor = shift(np.arange(sensed.first, sensed.end, dtype=np.float64))
        return [factor * signal for signal in received.signals(sensed)]

    return SensorInput(signals, received.responses)
