"""Samples of a measuring device of a plant, which it sends in packets."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .readings import Plant

Array = NDArray[np.float64]

CHUNK = 20_000  # samples computed at once


class Chunk(NamedTuple):
    """Successive samples, with the state of the plant at their times; (n,) each."""

    sample: NDArray[np.int64]
    """Numbers of the samples; sample 0 is taken at time 0."""
    time: Array
    """[s]"""
    angle: Array
    """Angle of the input since time 0 [rad]."""
    torque: Array
    """Torque at the input [N m]."""
    cycles: Array
    """Mesh cycles since time 0."""


def chunks(plant: Plant, rate: float) -> Iterator[Chunk]:
    """All samples of a device.

    Args:
        plant: the plant.
        rate: sample rate of the device [Hz].
    """
    total, course = int(plant.duration * rate), plant.course
    for first in range(0, total, CHUNK):
        sample = np.arange(first, min(first + CHUNK, total))
        time = sample / rate
        angle, torque = course.angle_at(time), course.torque_at(time)
        cycles = float(plant.train.cycles) * angle / (2.0 * math.pi)
        yield Chunk(sample, time, angle, torque, cycles)


def received(
    sample: NDArray[np.int64], size: int, lost: float, chance: np.random.Generator
) -> NDArray[np.bool_]:
    """Draw which samples are received.

    Args:
        sample: numbers of successive samples, (n,).
        size: samples of a packet.
        lost: share of packets that are lost.
        chance: random number generator.

    Returns:
        Whether the packet of a sample is received, (n,).
    """
    packet = sample // size
    delivered = ~(chance.random(packet[-1] - packet[0] + 1) < lost)
    return np.asarray(delivered[packet - packet[0]])
