"""Devices of a plant that send many samples at a time, in packets of which some are lost."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .device import Chunk, simulated
from .readings import Plant

CHUNK = 20_000  # samples computed at once


class Samples(NamedTuple):
    """Successive samples of a device."""

    sample: NDArray[np.int64]
    """Numbers of the samples, (n,); sample 0 is taken at time 0."""
    values: NDArray[Any]
    """Samples in the units of the channels, (n, channels)."""


def simulate_samples(plant: Plant, name: str) -> Iterator[Samples]:
    """Simulate a device of `DEVICES` whose rate is not 0, several packets at a time."""
    errors, device = plant.hidden.device(name), simulated(name)
    chance = np.random.default_rng([plant.hidden.seed, device.seed])
    measure = device.measure(plant, errors, chance)
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
    """Simulate a device of `DEVICES`, packet by packet."""
    size = plant.hidden.device(name).packet
    for sample, values in simulate_samples(plant, name):
        cuts = np.flatnonzero(np.diff(sample // size)) + 1
        for numbers, part in zip(np.split(sample, cuts), np.split(values, cuts), strict=True):
            if len(numbers):
                yield Samples(numbers, part)
