"""A tachometer on a shaft."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scene.sensors.tachometer import Tachometer
from .noise import Noise
from .reader import Sampling, empty_readings
from .sensed import Readings, Sensed
from .shafts import shaft_index

ITERATIONS = 4  # of Newton's method, from the time of a constant speed

Array = NDArray[np.float64]


class Motion(NamedTuple):
    """Motion of marks between samples, (intervals,) each."""

    begin: Array
    """Marks passed at the begin."""
    end: Array
    begin_speed: Array
    """Marks per interval at the begin."""
    end_speed: Array


class TachometerReader:
    """Reads a tachometer: the times at which a mark arrives.

    Between two samples, the angle is the cubic with their angles and speeds.

    Args:
        sensor: the sensor.
        samples: from which it reads.
    """

    def __init__(self, sensor: Tachometer, samples: Sampling) -> None:
        self._sensor, self._noise = sensor, Noise(sensor.seed, sensor.name)
        self._body, self._rate = shaft_index(samples.layout, sensor.shaft), samples.rate
        self.empty = empty_readings(sensor, sensor.kind, "s", 0.0)
        self._last: tuple[Array, Array] | None = None
        self._pulses = 0

    def read(self, block: Sensed, count: int) -> Readings:
        """Times of the pulses in a block and since the one before, see `Reader.read`."""
        marks = self._sensor.pulses / math.tau
        place = marks * np.ascontiguousarray(block.angle[:count, self._body])
        speed = marks / self._rate * np.ascontiguousarray(block.speed[:count, self._body])
        first = block.first
        if self._last is not None:
            place, speed = (
                np.concatenate(both) for both in zip(self._last, (place, speed), strict=True)
            )
            first -= 1
        self._last = place[-1:], speed[-1:]
        times = self._arrivals(Motion(place[:-1], place[1:], speed[:-1], speed[1:]), first)
        return self.empty._replace(first=block.first / self._rate, values=self._stamped(times))

    def _arrivals(self, motion: Motion, first: int) -> Array:
        """Times at which a mark arrives forwards at its first edge, backwards at its second [s]."""
        forwards = _crossings(motion, 0.0, forwards=True)
        backwards = _crossings(motion, self._sensor.width, forwards=False)
        return np.sort(np.concatenate([forwards, backwards]) + first) / self._rate

    def _stamped(self, times: Array) -> Array:
        """Times as the counter stamps them [s]."""
        clock = self._sensor.clock
        late = self._sensor.noise * self._noise.at(self._pulses, len(times))
        self._pulses += len(times)
        return np.asarray(np.floor((times + late) * clock) / clock)


def _crossings(motion: Motion, edge: float, forwards: bool) -> Array:
    """Times at which an edge of a mark passes, in intervals from the first sample on."""
    begin, end = np.floor(motion.begin - edge), np.floor(motion.end - edge)
    number = np.maximum(end - begin if forwards else begin - end, 0.0).astype(np.int64)
    interval = np.repeat(np.arange(len(number)), number)
    within = np.arange(len(interval)) - np.repeat(np.cumsum(number) - number, number)
    mark = begin[interval] + (within + 1.0 if forwards else -within) + edge
    return interval + _solved(Motion(*(values[interval] for values in motion)), mark)


def _solved(motion: Motion, mark: Array) -> Array:
    """Share of an interval after which a place is reached, (n,)."""
    way = motion.end - motion.begin
    third = motion.begin_speed + motion.end_speed - 2.0 * way
    second = way - motion.begin_speed - third
    share = (mark - motion.begin) / way
    for _ in range(ITERATIONS):
        place = ((third * share + second) * share + motion.begin_speed) * share
        slope = (3.0 * third * share + 2.0 * second) * share + motion.begin_speed
        slope = np.where(slope * way > 0.0, slope, way)
        share = np.clip(share - (place - (mark - motion.begin)) / slope, 0.0, 1.0)
    return share
