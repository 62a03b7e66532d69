"""A proximity probe beside a body."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..scene.sensors.proximity import Proximity
from .converter import Converter, ErrorModel
from .displaced import displacement_along
from .filtered import Filtered
from .filters import UNCHANGED
from .noise import Noise
from .path import SensorInput
from .reader import Sampling, empty_readings
from .sensed import Sensed


def proximity(sensor: Proximity, samples: Sampling) -> Filtered:
    """Make what reads a proximity probe: the way of a body towards the probe.

    Args:
        sensor: the sensor.
        samples: from which it reads, with displacements.
    """

    def signals(sensed: Sensed) -> list[NDArray[np.float64]]:
        return [displacement_along(sensed, sensor.body, sensor.angle)]

    errors = ErrorModel(sensor.noise, 0.0, 0.0)
    return Filtered(
        empty_readings(sensor, sensor.kind, "m", sensor.rate),
        SensorInput(signals, (UNCHANGED,)),
        UNCHANGED,
        samples.rate,
        samples.first,
        Converter(errors, Noise(sensor.seed, sensor.name), sensor.range, sensor.bits),
    )
