"""Measurements of a plant, in the order of time."""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from typing import Any, NamedTuple

from numpy.typing import NDArray

from ..following.channels.all import OIL
from ..following.channels.sampled import DEVICES
from .readings import Plant, simulate_readings
from .sampled import packets

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


class Packet(NamedTuple):
    """Successive samples of a device."""

    time: float
    """Time of the last sample [s]."""
    device: str
    """Its name in `DEVICES`."""
    first: int
    """Number of the first sample; sample 0 is taken at time 0."""
    values: NDArray[Any]
    """Samples in the units of the channels, (n, channels)."""


Measured = ShaftReading | OilReading | Packet


def timeline(plant: Plant) -> Iterator[Measured]:
    """Simulate the measurements of a plant: readings, and packets of samples, in order of time."""
    rates = {name: plant.hidden.device(name).rate for name in DEVICES}
    streams = [_packets(plant, name, rate) for name, rate in rates.items() if rate]
    return heapq.merge(_readings(plant), *streams, key=lambda measured: measured.time)


def _readings(plant: Plant) -> Iterator[Measured]:
    """Readings of the shafts, and of the oil once a second."""
    times, columns = simulate_readings(plant)
    oil = columns.pop(OIL)
    ratio = plant.train.ratio
    due = 0.0
    for n, time in enumerate(times.tolist()):
        angle = float(plant.course.angle_at(times[n : n + 1])[0])
        values = {name: float(column[n]) for name, column in columns.items()}
        yield ShaftReading(time, values, (angle, ratio * angle))
        if time >= due:
            due = time + EVERY
            yield OilReading(time, float(oil[n]))


def _packets(plant: Plant, name: str, rate: float) -> Iterator[Measured]:
    """Packets of a device, without the lost ones."""
    for sample, values in packets(plant, name):
        yield Packet(float(sample[-1]) / rate, name, int(sample[0]), values)
