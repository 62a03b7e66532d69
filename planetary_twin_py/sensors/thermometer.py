"""A thermometer in the oil."""

from __future__ import annotations

import math

import numpy as np
from scipy.signal import lfilter

from ..scene.sensors.thermometer import Thermometer
from .noise import Noise
from .reader import Sampling, Taken, empty_readings
from .sensed import Readings, Sensed


class ThermometerReader:
    """Reads a thermometer, which starts at the temperature of the oil.

    Args:
        sensor: the sensor.
        samples: from which it reads.
    """

    def __init__(self, sensor: Thermometer, samples: Sampling) -> None:
        self._sensor, self._noise = sensor, Noise(sensor.seed, sensor.name)
        self._kept = math.exp(-1.0 / (sensor.rate * sensor.time_constant))
        self._taken = Taken(samples.rate, sensor.rate)
        self.empty = empty_readings(sensor, sensor.kind, "K", sensor.rate)
        self._state: np.ndarray | None = None

    def read(self, block: Sensed, count: int) -> Readings:
        """Readings at the samples of a block, see `Reader.read`."""
        number, rows = self._taken.of(block, count)
        oil = np.broadcast_to(block.oil_temperature, len(block.angle))[rows]
        values = oil
        if len(oil):
            lag = [1.0 - self._kept], [1.0, -self._kept]
            state = self._kept * oil[:1] if self._state is None else self._state
            values, self._state = lfilter(*lag, oil, zi=state)
        values = values + self._sensor.noise * self._noise.at(number, len(values))
        return self.empty._replace(first=number / self._sensor.rate, values=values)
