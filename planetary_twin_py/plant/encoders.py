"""Counts of two encoders of a plant, on the input and output members."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from ..following.channels.sampled import COUNTS
from ..scene.quantity import quantity
from ..sensors.encoder import counts, wave
from .device import Array, Chunk, DeviceErrors, MeasuredPlant, SimulatedDevice
from .pattern import course_of


class EncoderErrors(DeviceErrors):
    """Errors of both encoders, which one device reads."""

    bits: int = Field(20, ge=8, le=32, description="counts per turn, as a power of two")
    noise: float = quantity("rad", "standard deviation of a sample", 1e-6, ge=0.0, le=1.0)
    long_wave: float = quantity("rad", "error once per turn, amplitude", 30e-6, ge=0.0, le=1.0)
    mesh_wave: float = quantity(
        "rad", "error at the mesh order of the encoder's shaft, amplitude", 1e-6, ge=0.0, le=1.0
    )
    jitter: float = quantity(
        "s", "standard deviation of the delay between both channels", 0.0, ge=0.0, le=1.0
    )
    delay: float = quantity("s", "constant delay between both channels", 2e-6, ge=-1.0, le=1.0)


def encoders(
    plant: MeasuredPlant, errors: EncoderErrors, chance: np.random.Generator
) -> Callable[[Chunk], NDArray[np.int64]]:
    """Function of some samples that returns the counts of both encoders since time 0, (n, 2)."""
    train = plant.train
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


def _fields(errors: EncoderErrors, first: int, values: NDArray[np.int64]) -> dict[str, Any]:
    """Fields of a message."""
    per_turn = dict.fromkeys(("input_counts_per_turn", "output_counts_per_turn"), 2**errors.bits)
    counted = dict(zip(COUNTS, values.T.tolist(), strict=True))
    return {"first_sample": first} | per_turn | counted


DEVICE = SimulatedDevice(EncoderErrors, dict.fromkeys(COUNTS, ""), encoders, 2, _fields)
