"""Measurements of a plant, in the order of time."""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from .encoders import simulate_encoders
from .readings import Plant, simulate_readings
from .vibration import simulate_vibration

Number = TypeVar("Number", bound=np.generic)
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


class AccelerationPacket(NamedTuple):
    """Successive samples of an accelerometer."""

    time: float
    """Time of the last sample [s]."""
    begin: float
    """Time of the first sample [s]."""
    values: NDArray[np.float64]
    """Accelerations [m/s^2], (n,)."""


Measured = ShaftReading | OilReading | CountPacket | AccelerationPacket


def timeline(plant: Plant) -> Iterator[Measured]:
    """Simulate the measurements of a plant.

    Args:
        plant: the plant.

    Returns:
        Readings, and packets of encoder samples and accelerations, in the order of time.

    Raises:
        SceneError: the scene cannot be simulated.
    """
    streams: list[Iterator[Measured]] = [_readings(plant)]
    if plant.hidden.sensors.encoders.rate:
        streams.append(_packets(plant))
    if plant.hidden.sensors.vibration.rate:
        streams.append(_accelerations(plant))
    return heapq.merge(*streams, key=lambda measured: measured.time)


def _readings(plant: Plant) -> Iterator[Measured]:
    """Readings of the shafts, and of the oil once a second."""
    times, columns = simulate_readings(plant)
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
    for chunk in simulate_encoders(plant):
        for sample, counts in _cut(chunk.sample, chunk.counts, errors.packet):
            yield CountPacket(float(sample[-1]) / errors.rate, int(sample[0]), counts)


def _accelerations(plant: Plant) -> Iterator[Measured]:
    """Packets of accelerations, without the lost ones."""
    sensor = plant.hidden.sensors.vibration
    for chunk in simulate_vibration(plant):
        for sample, values in _cut(chunk.sample, chunk.values, sensor.packet):
            first, last = float(sample[0]), float(sample[-1])
            yield AccelerationPacket(last / sensor.rate, first / sensor.rate, values)


def _cut(
    sample: NDArray[np.int64], values: NDArray[Number], packet: int
) -> Iterator[tuple[NDArray[np.int64], NDArray[Number]]]:
    """Numbers and values of the samples of each packet."""
    cuts = np.flatnonzero(np.diff(sample // packet)) + 1
    for numbers, part in zip(np.split(sample, cuts), np.split(values, cuts), strict=True):
        if len(numbers):
            yield numbers, part
