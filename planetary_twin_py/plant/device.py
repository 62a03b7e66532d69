"""What simulates a device of many samples: its errors, its messages, and the plant it measures."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from ..following.train import FollowedTrain
from ..scene.quantity import Section, quantity
from .course import Course
from .pattern import Stage

Array = NDArray[np.float64]


class DeviceErrors(Section):
    """Rate and lost packets of a device; a class of each device adds its errors."""

    rate: float = quantity("Hz", "sample rate; 0: no such device", 0.0, ge=0.0, le=1e6)
    packet: int = Field(200, ge=1, le=100_000, description="samples of a packet")
    lost: float = quantity("", "share of packets that are lost", 0.0, ge=0.0, lt=1.0)


class MeasuredPlant(Protocol):
    """What a device measures of a plant."""

    @property
    def train(self) -> FollowedTrain:
        """The train with the laws of the plant."""

    @property
    def course(self) -> Course:
        """Torque and speed over time."""

    @property
    def error_stages(self) -> tuple[Stage, ...]:
        """Transmission error before and after every change of faults; it takes seconds."""


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


class SimulatedDevice(NamedTuple):
    """A device of a plant."""

    errors: type[DeviceErrors]
    units: dict[str, str]
    """Unit by channel; empty for counts, whose samples are numbered in a table."""
    measure: Callable[[MeasuredPlant, Any, np.random.Generator], Callable[[Chunk], NDArray[Any]]]
    """Makes the function of some samples that returns their values, (n, channels), with errors."""
    seed: int
    """Of its random numbers, beside that of the plant."""
    fields: Callable[[Any, int, NDArray[Any]], Mapping[str, Any]] | None = None
    """Fields of a message, from errors, number of the first sample and values; None: those of a
    `SampledBlock`."""

    def message_fields(self, errors: DeviceErrors, first: int, values: NDArray[Any]) -> Any:
        """Fields of a message with samples of a packet, besides its number and its period."""
        if self.fields is not None:
            return self.fields(errors, first, values)
        units = {"names": list(self.units), "units": list(self.units.values())}
        return units | {"samples": values.T.ravel().tolist()}


def simulated(name: str) -> SimulatedDevice:
    """A device of `DEVICES`."""
    device: SimulatedDevice = import_module(f".{name}", __package__).DEVICE
    return device
