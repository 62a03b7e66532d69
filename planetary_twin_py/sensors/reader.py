"""What reads a sensor while a gearbox runs."""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from ..model.layout import Layout
from ..scene.sensors.sensor import Sensor
from .sensed import Readings, Sensed


class Sampling(NamedTuple):
    """The samples from which sensors read."""

    layout: Layout
    """The gearbox."""
    rate: float
    """Of the samples [Hz]."""
    first: int
    """Number of the first sample."""
    mean_force: NDArray[np.float64] | None
    """Mean forces of the ring meshes over all samples [N], (planets,); None: not known yet."""


class Reader(Protocol):
    """Reads a sensor."""

    empty: Readings
    """Readings without values."""

    def read(self, block: Sensed, count: int) -> Readings:
        """Readings that consecutive samples complete.

        Args:
            block: the samples that follow those before.
            count: number of its first samples that are valid.
        """
        ...


def empty_readings(sensor: Sensor, kind: str, unit: str, rate: float) -> Readings:
    """Readings without values.

    Args:
        sensor: the sensor.
        kind: its kind.
        unit: of its values.
        rate: its sample rate [Hz]; 0 without one.
    """
    return Readings(sensor.name, kind, unit, 0.0, 1.0 / rate if rate else 0.0, np.empty(0), 0)


class Taken:
    """Which of the samples a sensor takes that reads at instants.

    Args:
        rate: of the samples [Hz].
        sensor_rate: of the sensor [Hz].
    """

    def __init__(self, rate: float, sensor_rate: float) -> None:
        self._ratio = round(rate / sensor_rate)

    def of(self, block: Sensed, count: int) -> tuple[int, slice]:
        """Number of the first one among the samples of the sensor, and their rows in a block."""
        number = -(-block.first // self._ratio)
        return number, slice(number * self._ratio - block.first, count, self._ratio)
