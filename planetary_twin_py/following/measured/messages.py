"""Converts ROS 2 messages, live or recorded, to readings and samples.

Empty fields of a message, and NaN, are missing readings. Temperatures are in degrees Celsius, as
sensor_msgs defines them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from ..channels.all import OIL, SENSORS
from ..channels.message_types import JOINTS, TEMPERATURE
from ..channels.sampled import DEVICES, MESSAGES, SampledMessages, Samples
from ..channels.stamp import stamp_of
from ..channels.temperature import ZERO_CELSIUS
from ..checks.position_check import PositionCheck
from ..devices.device import followed
from ..input_error import InputError
from ..readings import Readings
from ..sensors import JointNames

KINDS = (*JOINTS, TEMPERATURE, *MESSAGES)
"""Types of messages that are read."""
INTERFACES = {sensor.interface: sensor.quantity for sensor in SENSORS.values() if sensor.interface}
"""Quantities by the interfaces of a joint."""

Block = Readings | Samples
"""What messages contain."""


class Arrived(NamedTuple):
    """A received message."""

    sender: str
    """Topic of the message."""
    kind: str
    """Type of the message, one of `KINDS`."""
    time: float
    """Time of arrival by the clock of the receiver [s]."""
    message: Any


class _Row(NamedTuple):
    """Readings of one message."""

    sender: str
    stamp: float  # [s]
    arrival: float  # [s]
    values: dict[str, float]  # by channel, in SI


class MessageReader:
    """Converts messages of two joints in the order of their arrival.

    The factors `scale` are for the comparison of speeds with positions.
    """

    def __init__(self, joints: JointNames, scale: Mapping[str, float] | None = None) -> None:
        self._joints = {"input": joints.input, "output": joints.output}
        factors = scale or {}
        self._positions = {
            name: PositionCheck(name, factors.get(name, 1.0))
            for name, sensor in SENSORS.items()
            if sensor.quantity == "speed"
        }
        self._unset: dict[str, int] = {}  # messages whose stamp is 0, by sender
        self._sampled: dict[tuple[str, str], SampledMessages] = {}  # by device and sender
        self._unused: dict[str, str] = {}  # why blocks are not used, by sender
        self._senders: dict[tuple[str, ...], str] = {}  # by channels

    def read(self, arrived: Iterable[Arrived]) -> Iterator[Block]:
        """Convert messages of a short time, in the order of their arrival.

        Successive readings with the same sender and channels are one block, then follow the samples
        of each sensor, which does not affect estimates. Raises `InputError` if a block of samples
        has another format than the one before, or none, or if two senders have the same channels.
        """
        rows: list[_Row] = []
        samples: dict[tuple[str, str], list[Samples]] = {}
        for received in arrived:
            if received.kind in MESSAGES:
                if device := self._device_of(received):
                    read = self._sampled[device].read(received.sender, received.message)
                    self._check_sender(received.sender, read)
                    samples.setdefault(device, []).append(read)
                continue
            values = self._readings(received)
            if values:
                row = _Row(received.sender, self._stamp(received), received.time, values)
                if rows and not _same_channels(rows[-1], row):
                    yield _join_rows(rows)
                    rows = []
                rows.append(row)
        if rows:
            yield _join_rows(rows)
        for device, blocks in samples.items():
            yield self._sampled[device].join(blocks)

    def _device_of(self, received: Arrived) -> tuple[str, str] | None:
        """The first device that uses a block, and its sender; None: a remark says why none does."""
        for name in (one.name for one in DEVICES.values() if one.message == received.kind):
            if (key := (name, received.sender)) not in self._sampled:
                self._sampled[key] = followed(name).messages()
            if not (reason := self._sampled[key].unused(received.message)):
                return key
        self._unused[received.sender] = reason
        return None

    def _check_sender(self, sender: str, read: Samples) -> None:
        """Raise `InputError` if another sender has the same channels."""
        other = self._senders.setdefault(read.names, sender)
        if other != sender:
            raise InputError(
                f"{other} and {sender}: both send {', '.join(read.names)}: follow one of them, or "
                "give the channels different names"
            )

    def remarks(self) -> Iterator[str]:
        """A line for each sender without stamps or whose blocks are not used, and for positions
        unlike the speed of a shaft."""
        for sender, count in self._unset.items():
            yield (
                f"{sender}: {count} messages have the stamp 0, as header.stamp was not set: they "
                "are not used"
            )
        for sender, reason in self._unused.items():
            yield f"{sender}: {reason}: not used"
        for check in self._positions.values():
            yield from check.remarks()

    def _stamp(self, received: Arrived) -> float:
        """Stamp of a message [s]; NaN where it is 0, which means that it was not set."""
        stamp = stamp_of(received.message)
        if stamp == 0.0:
            self._unset[received.sender] = self._unset.get(received.sender, 0) + 1
            return math.nan
        return stamp

    def _readings(self, received: Arrived) -> dict[str, float]:
        """Readings of a message by channel, in SI."""
        if received.kind == TEMPERATURE:
            return {OIL: float(received.message.temperature) + ZERO_CELSIUS}
        values: dict[str, float] = {}
        for side, joint in self._joints.items():
            of_joint = _joint_values(received.message, joint)
            position = of_joint.pop("position", None)
            for interface, value in of_joint.items():
                values[f"{side}_{INTERFACES[interface]}"] = value
            speed = values.get(f"{side}_speed")
            if position is not None and speed is not None:
                stamp = stamp_of(received.message)
                self._positions[f"{side}_speed"].add(stamp, position, speed)
        return values


def _joint_values(message: Any, joint: str) -> dict[str, float]:
    """Position and readings of a joint in a message, by interface."""
    names = list(message.joint_names if hasattr(message, "joint_names") else message.name)
    if joint not in names:
        return {}
    index, wanted = names.index(joint), ("position", *INTERFACES)
    if hasattr(message, "interface_values"):
        of_joint = message.interface_values[index]
        pairs = zip(of_joint.interface_names, of_joint.values, strict=False)
        given = dict(reversed(list(pairs)))  # the first of a name counts
        return {name: float(given[name]) for name in wanted if name in given}
    columns = {name: getattr(message, name) for name in wanted}
    return {name: float(read[index]) for name, read in columns.items() if len(read) > index}


def _same_channels(first: _Row, second: _Row) -> bool:
    return first.sender == second.sender and [*first.values] == [*second.values]


def _join_rows(rows: list[_Row]) -> Readings:
    """Join rows to one block."""
    columns = {name: np.array([row.values[name] for row in rows]) for name in rows[0].values}
    stamp, arrival = (np.array([row[k] for row in rows]) for k in (1, 2))
    return Readings(stamp, columns, arrival, rows[0].sender)
