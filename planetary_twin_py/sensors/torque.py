"""A torque transducer on a shaft."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..model.layout import LOAD_MACHINE, MOTOR, SECOND_MOTOR
from ..scene.sensors.torque import Torque, TorqueErrors
from .converter import Converter, ErrorModel
from .filtered import Filtered
from .filters import UNCHANGED, Response
from .mode import Mode
from .noise import Noise
from .path import SensorInput
from .reader import Sampling, empty_readings
from .sensed import Sensed

MACHINES = {"input": MOTOR, "output": LOAD_MACHINE, "second_input": SECOND_MOTOR}
BUTTERWORTH = math.sqrt(0.5)  # damping ratio


def torque(sensor: Torque, samples: Sampling) -> Filtered:
    """Make what reads a torque transducer.

    Args:
        sensor: the sensor.
        samples: from which it reads.
    """
    machine = MACHINES[sensor.shaft]
    mode = Mode(math.tau * sensor.bandwidth, BUTTERWORTH)

    def signals(sensed: Sensed) -> list[NDArray[np.float64]]:
        return [np.ascontiguousarray(sensed.torque[:, machine])]

    return Filtered(
        empty_readings(sensor, sensor.kind, "N m", sensor.rate),
        SensorInput(signals, (Response(mode.displacement, (mode,)),)),
        UNCHANGED,
        samples.rate,
        samples.first,
        Converter(
            torque_errors(sensor), Noise(sensor.seed, sensor.name), sensor.range, sensor.bits
        ),
    )


def torque_errors(errors: TorqueErrors) -> ErrorModel:
    """Errors of a transducer as they act on its readings."""
    return ErrorModel(errors.noise, errors.zero, errors.gain)
