"""Counts of two encoders of a plant, on the input and output members."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .hidden import EncoderErrors
from .packets import chunks, received
from .pattern import course_of
from .readings import Plant

Array = NDArray[np.float64]


class EncoderCounts(NamedTuple):
    """Successive samples of both encoders."""

    sample: NDArray[np.int64]
    """Numbers of the samples, (n,); sample 0 is taken at time 0."""
    counts: NDArray[np.int64]
    """Counts of input and output since time 0, (n, 2)."""


def simulate_encoders(plant: Plant) -> Iterator[EncoderCounts]:
    """Simulate the encoders of a plant, in packets of which some are lost.

    Args:
        plant: the plant; `hidden.sensors.encoders.rate` must not be 0.

    Returns:
        Counts of several packets at a time.
    """
    train = plant.train
    errors = plant.hidden.sensors.encoders
    chance = np.random.default_rng([plant.hidden.seed, 2])
    phases = chance.uniform(0.0, 2.0 * math.pi, 4)
    for sample, time, angle, torque, cycles in chunks(plant, errors.rate):
        twist = course_of(plant.error_stages, time, cycles, torque) / train.lever
        output = (float(train.twist[0]) * angle - twist) / float(train.twist[1])
        delay = errors.delay + errors.jitter * chance.standard_normal(len(time))
        read = output + train.ratio * plant.course.speed_at(time) * delay
        orders = float(train.cycles), float(train.cycles) / train.ratio
        columns = [
            _counts(value, order, errors, phases[2 * k : 2 * k + 2], chance)
            for k, (value, order) in enumerate(zip((angle, read), orders, strict=True))
        ]
        delivered = received(sample, errors.packet, errors.lost, chance)
        yield EncoderCounts(sample[delivered], np.stack(columns, axis=1)[delivered])


def _counts(
    angle: Array, order: float, errors: EncoderErrors, phases: Array, chance: np.random.Generator
) -> NDArray[np.int64]:
    """Counts of one encoder."""
    reading = angle + errors.long_wave * np.sin(angle + phases[0])
    reading = reading + errors.mesh_wave * np.sin(order * angle + phases[1])
    reading = reading + errors.noise * chance.standard_normal(len(angle))
    return np.floor(reading * 2.0**errors.bits / (2.0 * math.pi)).astype(np.int64)
