"""Measurements of a plant, in the order of time."""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .encoders import play_encoders
from .readings import Plant, play_readings

WARMTH = "oil_temperature"
EVERY = 1.0  # [s] between two readings of the oil temperature


class ShaftReading(NamedTuple):
    """Readings of both shafts at one time."""

    time: float
    """[s]."""
    values: dict[str, float]
    """Values by channel in SI; NaN if a reading is lost."""
    angles: tuple[float, float]
    """Angles of input and output since time 0 [rad]."""


class OilReading(NamedTuple):
    """A reading of the oil temperature."""

    time: float
    """[s]."""
    temperature: float
    """[K]."""


class CountPacket(NamedTuple):
    """Successive samples of both encoders."""

    time: float
    """Time of the last sample [s]."""
    first: int
    """Number of the first sample; sample 0 is taken at time 0."""
    counts: NDArray[np.int64]
    """Counts of input and output since time 0, (n, 2)."""


Measured = ShaftReading | OilReading | CountPacket


def timeline(plant: Plant) -> Iterator[Measured]:
    """Simulate the measurements of a plant.

    Args:
        plant: the plant.

    Returns:
        Readings and packets of encoder samples, in the order of time.

    Raises:
        SceneError: the scene cannot be simulated.
    """
    streams: list[Iterator[Measured]] = [_readings(plant)]
    if plant.hidden.sensors.encoders.rate:
        streams.append(_packets(plant))
    return heapq.merge(*streams, key=lambda one: one.time)


def _readings(plant: Plant) -> Iterator[Measured]:
    """Readings of the shafts, and of the oil once a second."""
    times, columns = play_readings(plant)
    oil = columns.pop(WARMTH)
    ratio = plant.train.ratio
    due = 0.0
    for n, time in enumerate(times.tolist()):
        angle = float(plant.course.angle_at(times[n : n + 1])[0])
        values = {name: float(column[n]) for name, column in columns.items()}
        yield ShaftReading(time, values, (angle, ratio * angle))
        if time >= due:
            due = time + EVERY
            yield OilReading(time, float(oil[n]))


def _packets(plant: Plant) -> Iterator[Measured]:
    """Packets of encoder samples, without the lost ones."""
    errors = plant.hidden.sensors.encoders
    for found in play_encoders(plant):
        cuts = np.flatnonzero(np.diff(found.sample // errors.packet)) + 1
        parts = zip(np.split(found.sample, cuts), np.split(found.counts, cuts), strict=True)
        for sample, counts in parts:
            if len(sample):
                yield CountPacket(float(sample[-1]) / errors.rate, int(sample[0]), counts)
