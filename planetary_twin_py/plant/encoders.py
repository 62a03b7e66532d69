"""Counts of two encoders of a plant, on the input and output members."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..sensors.encoder import counts, wave
from .chunk import Array, Chunk
from .hidden import EncoderErrors
from .pattern import course_of
from .readings import Plant


def encoders(plant: Plant, chance: np.random.Generator) -> Callable[[Chunk], NDArray[np.int64]]:
    """Function of some samples that returns the counts of both encoders since time 0, (n, 2)."""
    train, errors = plant.train, plant.hidden.sensors.encoders
    orders = float(train.cycles), float(train.cycles) / train.ratio
    phases = chance.uniform(0.0, 2.0 * math.pi, (2, 2))

    def read(chunk: Chunk) -> NDArray[np.int64]:
        twist = course_of(plant.error_stages, chunk.time, chunk.cycles, chunk.torque) / train.lever
        output = (float(train.twist[0]) * chunk.angle - twist) / float(train.twist[1])
        delay = errors.delay + errors.jitter * chance.standard_normal(len(chunk.time))
        late = output + train.ratio * plant.course.speed_at(chunk.time) * delay
        ends = zip((chunk.angle, late), orders, phases, strict=True)
        return np.stack([_counts(*end, errors, chance) for end in ends], axis=1)

    return read


def _counts(
    angle: Array, order: float, phases: Array, errors: EncoderErrors, chance: np.random.Generator
) -> NDArray[np.int64]:
    """Counts of one encoder."""
    reading = angle + wave(angle, errors.long_wave, phases[0])
    reading = reading + wave(order * angle, errors.mesh_wave, phases[1])
    reading = reading + errors.noise * chance.standard_normal(len(angle))
    return counts(reading, 2.0**errors.bits)
