"""An encoder on a shaft."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..scene.sensors.encoder import Encoder
from .noise import Noise
from .reader import Sampling, Taken, empty_readings
from .sensed import Readings, Sensed
from .shafts import shaft_index

Array = NDArray[np.float64]


def wave(angle: Array, amplitude: float, phase: float) -> Array:
    """Periodic error of an encoder [rad], (n,).

    Args:
        angle: of the shaft times the number of waves per turn [rad], (n,).
        amplitude: of the error [rad].
        phase: angle by which it leads [rad].
    """
    return np.asarray(amplitude * np.sin(angle + phase))


def counts(angle: Array, per_turn: float) -> NDArray[np.int64]:
    """Whole counts since angle 0, (n,).

    Args:
        angle: that the disc shows [rad], (n,).
        per_turn: counts of a turn.
    """
    return np.floor(angle * per_turn / (2.0 * math.pi)).astype(np.int64)


class EncoderReader:
    """Reads an encoder.

    Args:
        sensor: the sensor.
        samples: from which it reads.
    """

    def __init__(self, sensor: Encoder, samples: Sampling) -> None:
        self._sensor, self._noise = sensor, Noise(sensor.seed, sensor.name)
        self._body = shaft_index(samples.layout, sensor.shaft)
        self._taken = Taken(samples.rate, sensor.rate)
        self.empty = empty_readings(sensor, sensor.kind, "counts", sensor.rate)

    def read(self, block: Sensed, count: int) -> Readings:
        """Readings at the samples of a block, see `Reader.read`."""
        sensor = self._sensor
        number, rows = self._taken.of(block, count)
        shown = self._shown(np.ascontiguousarray(block.angle[:, self._body]))[rows]
        shown = shown + sensor.noise * self._noise.at(number, len(shown))
        values = counts(shown, sensor.counts_per_turn)
        return self.empty._replace(first=number / sensor.rate, values=values)

    def _shown(self, angle: Array) -> Array:
        """Angle that the disc shows [rad], (n,): the mean of all heads.

        An eccentricity e at the radius R of the track is an error (e/R) sin at each head, whose
        phase is the place of the head.
        """
        sensor = self._sensor
        if not sensor.radius:
            return angle
        amplitude = sensor.eccentricity / sensor.radius
        places = math.tau / sensor.heads * np.arange(sensor.heads)
        errors = [wave(angle, amplitude, place - sensor.phase) for place in places]
        return np.asarray(angle + sum(errors) / sensor.heads)
