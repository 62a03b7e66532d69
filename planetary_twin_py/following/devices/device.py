"""What reads the samples of a device, and what follows them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ...scene import Scene
from ..balance.follower import BalanceFollower
from ..channels.sampled import SampledMessages, Samples
from ..estimate import Estimate, Event
from ..sensors import Sensors
from ..teeth.baseline_file import SavedBaseline


class DeviceState(NamedTuple):
    """What the samples of a device show."""

    estimates: Sequence[Estimate] = ()
    events: Sequence[Event] = ()
    counters: Mapping[str, int] = {}
    """Numbers of samples that were not used, by reason, and others."""
    judged: Mapping[str, bool] = {}
    """Whether a change could have been found, by what is measured."""
    fields: Mapping[str, Any] = {}
    """Fields of `Following` that no other device has."""


@dataclass
class DeviceFollower:
    """Follows the samples of a device; one that learns no baseline keeps the methods of it."""

    scene: Scene
    sensors: Sensors
    balance: BalanceFollower
    """Gives speed and torque of the gearbox."""

    def add(self, block: Any) -> None:
        """Add samples in the order of their arrival.

        Raises `InputError` if they contradict the scene or those before.
        """
        raise NotImplementedError

    def judge(self, until: float) -> None:
        """Judge what the samples show up to a time [s]."""

    def finish(self) -> None:
        """Process the samples that are held back, at the end of a recording."""
        if math.isfinite(self.balance.time):
            self.judge(self.balance.time)

    def state(self) -> DeviceState:
        """What the samples show so far."""
        return DeviceState()

    def remarks(self) -> Iterator[str]:
        """Reasons why less is judged, or nothing."""
        return iter(())

    def learn(self) -> None:
        """Forget baselines and learn new ones."""

    def saved(self) -> Mapping[str, Any]:
        """Fields of `SavedBaseline` that have been learned."""
        return {}

    def restore(self, saved: SavedBaseline) -> None:
        """Use saved baselines instead of learning."""


class FollowedDevice(NamedTuple):
    """The parts of a device."""

    messages: Callable[[], SampledMessages]
    """Makes what converts the messages of a sender."""
    read: Callable[[Path, Sensors, np.datetime64 | None], Samples]
    """Reads a table, with the date of second 0 of the stamps of the readings, if they have dates;
    raises `ValueError` if it is another one, and `OSError`."""
    follower: type[DeviceFollower]


def followed(name: str) -> FollowedDevice:
    """The parts of a device of `DEVICES`."""
    parts: FollowedDevice = import_module(f".{name}", __package__).DEVICE
    return parts
