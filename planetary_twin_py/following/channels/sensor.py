"""What a sensor of one value at a time is: where it measures what, in which unit, within limits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..train import FollowedTrain

Array = NDArray[np.float64]


class Range(NamedTuple):
    """Values that a channel can have, in SI."""

    low: float
    high: float
    limit: str
    """What limits them, with the value."""


@dataclass(frozen=True)
class Sensor:
    """A sensor of one value at a time.

    Messages, tables and recordings, the checks of followers and fleets, and plants read here what
    they need of it.
    """

    name: str
    """Of the channel, as in gearbox_state."""
    quantity: str
    unit: str
    """SI unit of its readings."""
    spellings: tuple[str, ...]
    """Other units that a heading may state, the usual one first."""
    nominal: Callable[[FollowedTrain], float]
    """Magnitude of a reading at the operating point of the scene, in SI."""
    limits: Callable[[FollowedTrain], Range]
    """Values that readings of a scene can have."""
    written: tuple[tuple[float, float], ...]
    """Factors and offsets from SI to the units in which a logger may have written a code."""
    interface: str = ""
    """Its interface of a joint in a message; empty if it is not that of a joint."""
    shown: float = 0.0
    """Share of the nominal value below which readings say nothing about a unit or a sign."""

    def refusal(self, allowed: Range) -> str:
        """How to state the unit of a channel most of whose readings are beyond its limits."""
        return (
            f"exceeds {allowed.limit}; is it in {self.unit}? A column in {self.spellings[0]} is "
            f"headed {self.name} [{self.spellings[0]}], also possible are "
            f"{', '.join(self.spellings[1:])}; or scale {self.name} by a factor"
        )


def at_shaft(place: str, quantity: str, at_input: float, train: FollowedTrain) -> float:
    """Speed or torque of the input, or, without losses, of the output, from that of the input."""
    if place == "input":
        return at_input
    ratio = abs(train.ratio)
    return at_input * ratio if quantity == "speed" else at_input / ratio


def range_at(place: str, quantity: str, unit: str, highest: float, train: FollowedTrain) -> Range:
    """Speeds or torques of a shaft up to a multiple of the limit of the scene."""
    limit = f"{quantity}_limit"
    largest = at_shaft(place, quantity, highest * getattr(train, limit), train)
    seen = "" if place == "input" else f" at the {place}"
    text = f"{highest:g} times drive.{limit}{seen}, {largest:.4g} {unit}"
    return Range(-largest, largest, text)
