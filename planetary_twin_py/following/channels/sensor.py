"""What a sensor of one value at a time is: where it measures what, in which unit, within limits."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..train import FollowedTrain

Array = NDArray[np.float64]


class Range(NamedTuple):
    """Values that a channel can have, in SI."""

    low: float
    high: float
    limited_by: str
    """What limits them."""


class ErrorModel(NamedTuple):
    """Errors of a sensor, or their standard deviations: (1 + gain) value + zero + noise."""

    noise: float
    """Standard deviation of a reading, in SI."""
    zero: float
    """In SI."""
    gain: float

    def reading(self, value: Array, normal: Array) -> Array:
        """What the sensor reads.

        Args:
            value: true values in SI, (n,).
            normal: standard normal random numbers, (n,).

        Returns:
            Readings in SI, (n,).
        """
        return value * (1.0 + self.gain) + self.zero + self.noise * normal


@dataclass(frozen=True)
class Sensor(ABC):
    """A sensor of one value at a time, of the channel PLACE_QUANTITY.

    Messages with joints, tables, recordings, the checks of a follower and of a fleet, and a plant
    read what they need here.
    """

    quantity: ClassVar[str]
    unit: ClassVar[str]
    """SI unit of its readings."""
    spellings: ClassVar[str]
    """Other units that a heading may state."""
    interface: ClassVar[str] = ""
    """Its interface of a joint in a message; empty if it is not that of a joint."""
    shown: ClassVar[float] = 0.0
    """Share of the nominal value below which readings say nothing about a unit or a sign."""
    place: str
    """"input", "output" or "oil"."""

    @property
    def name(self) -> str:
        """Name of the channel, as in gearbox_state."""
        return f"{self.place}_{self.quantity}"

    @abstractmethod
    def nominal(self, train: FollowedTrain) -> float:
        """Magnitude of a reading at the operating point of the scene, in SI."""

    @abstractmethod
    def limits(self, train: FollowedTrain) -> Range:
        """Values that readings of a scene can have."""

    @abstractmethod
    def as_written(self, values: Array) -> list[Array]:
        """Readings in SI in the units in which a logger may have written them."""

    def beyond(self, allowed: Range) -> str:
        """Why a reading beyond the limits is left out."""
        return f"it exceeds {allowed.limited_by}, {allowed.high:.4g} {self.unit}"

    def refusal(self, allowed: Range) -> str:
        """The range of a channel most of whose readings are beyond it, and how to state a unit."""
        return (
            f"exceeds {allowed.limited_by} = {allowed.high:.4g} {self.unit}; is it in {self.unit}? "
            f"A heading states another unit ({self.spellings}), as in {self.name} [UNIT], or scale "
            f"{self.name} by a factor"
        )
