"""Sensors of a plant that send many samples at a time, in packets of which some are lost."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..following.channels.encoders import COUNTS
from .chunk import Chunk
from .encoders import encoders
from .readings import Plant
from .vibration import NAME, accelerometer

CHUNK = 20_000  # samples computed at once


class Sampled(NamedTuple):
    """A sensor."""

    units: dict[str, str]
    """Unit by channel; empty for counts, whose samples are numbered in a table."""
    measure: Callable[[Plant, np.random.Generator], Callable[[Chunk], NDArray[Any]]]
    """Makes the function of some samples that returns their values, (n, channels)."""
    seed: int
    """Of its random numbers, beside that of the plant."""


SAMPLED = {
    "encoders": Sampled(dict.fromkeys(COUNTS, ""), encoders, 2),
    "vibration": Sampled({NAME: "m/s^2"}, accelerometer, 3),
}
"""Sensors by the name of their errors in `SensorErrors`."""


class Samples(NamedTuple):
    """Successive samples of a sensor."""

    sample: NDArray[np.int64]
    """Numbers of the samples, (n,); sample 0 is taken at time 0."""
    values: NDArray[Any]
    """Samples in the units of the channels, (n, channels)."""


def simulate_samples(plant: Plant, name: str) -> Iterator[Samples]:
    """Simulate a sensor of `SAMPLED` whose rate is not 0, several packets at a time."""
    errors, sensor = getattr(plant.hidden.sensors, name), SAMPLED[name]
    chance = np.random.default_rng([plant.hidden.seed, sensor.seed])
    measure = sensor.measure(plant, chance)
    total, course = int(plant.duration * errors.rate), plant.course
    for first in range(0, total, CHUNK):
        sample = np.arange(first, min(first + CHUNK, total))
        time = sample / errors.rate
        angle, torque = course.angle_at(time), course.torque_at(time)
        cycles = float(plant.train.cycles) * angle / (2.0 * math.pi)
        values = measure(Chunk(sample, time, angle, torque, cycles))
        packet = sample // errors.packet
        delivered = ~(chance.random(packet[-1] - packet[0] + 1) < errors.lost)
        arrived = delivered[packet - packet[0]]
        yield Samples(sample[arrived], values[arrived])


def packets(plant: Plant, name: str) -> Iterator[Samples]:
    """Simulate a sensor of `SAMPLED`, packet by packet."""
    size = getattr(plant.hidden.sensors, name).packet
    for sample, values in simulate_samples(plant, name):
        cuts = np.flatnonzero(np.diff(sample // size)) + 1
        for numbers, part in zip(np.split(sample, cuts), np.split(values, cuts), strict=True):
            if len(numbers):
                yield Samples(numbers, part)
