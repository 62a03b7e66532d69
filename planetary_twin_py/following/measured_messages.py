"""Converts ROS 2 messages, live or recorded, to readings and encoder samples.

Empty fields of a message, and NaN, are missing readings. Temperatures are in degrees Celsius, as
sensor_msgs defines them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from .checks import InputError
from .follower import EncoderFormat, EncoderSamples, Readings
from .position_check import PositionCheck
from .sensors import JointNames
from .vibration import VibrationSamples

JOINTS = ("sensor_msgs/msg/JointState", "control_msgs/msg/DynamicJointState")
TEMPERATURE = "sensor_msgs/msg/Temperature"
ENCODERS = "planetary_twin_msgs/msg/EncoderBlock"
VIBRATION = "planetary_twin_msgs/msg/SampledBlock"
BLOCKS = (ENCODERS, VIBRATION)
"""Types of messages that have many samples."""
KINDS = (*JOINTS, TEMPERATURE, *BLOCKS)
"""Types of messages that are read."""
SIDES = "input", "output"
ZERO_CELSIUS = 273.15  # [K]
INTERFACES = {"velocity": "speed", "effort": "torque"}
"""Quantities by the interfaces of a joint."""
SET = 1.0  # [s] difference of stamps and sample numbers above which a clock must have been set


Block = Readings | EncoderSamples | VibrationSamples
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
    """Converts messages in the order of their arrival.

    Args:
        joints: names of the joints of input and output.
        scale: factors on readings by channel, for the check of the unit of speeds.
    """

    def __init__(self, joints: JointNames, scale: Mapping[str, float] | None = None) -> None:
        self._joints = joints
        factors = scale or {}
        self._positions = {
            side: PositionCheck(f"{side}_speed", factors.get(f"{side}_speed", 1.0))
            for side in SIDES
        }
        self._number: int | None = None  # of a device's sample 0, in periods since time 0
        self._format: EncoderFormat | None = None
        self._channels: tuple[tuple[str, ...], float] | None = None  # of vibration, and period

    def read(self, arrived: Iterable[Arrived]) -> Iterator[Block]:
        """Convert messages.

        Args:
            arrived: messages of a short time, in the order of their arrival.

        Returns:
            Readings in the same order, successive ones with the same sender and channels in one
            block, then samples of encoders and of vibration in one block each. The order of
            readings and samples does not affect the estimates of a follower.

        Raises:
            InputError: a block of samples has another format than the one before, or none; or
                positions show that a speed has another unit.
        """
        rows: list[_Row] = []
        samples: list[EncoderSamples] = []
        vibration: list[VibrationSamples] = []
        for one in arrived:
            if one.kind == ENCODERS:
                samples.append(self._samples(one))
                continue
            if one.kind == VIBRATION:
                vibration.append(self._vibration(one))
                continue
            values = self._values(one)
            if values:
                row = _Row(one.sender, stamp_of(one.message), one.time, values)
                if rows and not _same_channels(rows[-1], row):
                    yield _together(rows)
                    rows = []
                rows.append(row)
        if rows:
            yield _together(rows)
        if samples:
            yield _joined(samples)
        if vibration:
            yield vibration[0]._replace(
                time=np.concatenate([one.time for one in vibration]),
                values=np.concatenate([one.values for one in vibration]),
            )

    def _values(self, one: Arrived) -> dict[str, float]:
        if one.kind == TEMPERATURE:
            return {"oil_temperature": float(one.message.temperature) + ZERO_CELSIUS}
        values: dict[str, float] = {}
        for side, joint in zip(SIDES, (self._joints.input, self._joints.output), strict=True):
            found = _shaft(one.message, joint)
            values |= {
                f"{side}_{INTERFACES[name]}": found[name] for name in INTERFACES if name in found
            }
            if "position" in found and "velocity" in found:
                stamp = stamp_of(one.message)
                self._positions[side].add(stamp, found["position"], found["velocity"])
        return values

    def _samples(self, one: Arrived) -> EncoderSamples:
        """Return the samples of a block, numbered from time 0 of the stamps."""
        block = one.message
        counts = np.array([block.input_counts, block.output_counts], dtype=np.int64)
        found = EncoderFormat(
            (int(block.input_counts_per_turn), int(block.output_counts_per_turn)),
            float(block.sample_period),
        )
        if self._format is None:
            _check(one.sender, found)
            self._format = found
        if found != self._format:
            raise InputError(
                f"{one.sender}: counts per turn and period are {_words(found)}: must be "
                f"{_words(self._format)} as in the blocks before"
            )
        begin = round(stamp_of(block) / found.period)
        first = int(block.first_sample)
        apart = 0 if self._number is None else abs(self._number + first - begin)
        if self._number is None or apart * found.period > SET:
            self._number = begin - first
        return EncoderSamples(
            self._number + first + np.arange(counts.shape[1], dtype=np.int64), counts.T, found
        )

    def _vibration(self, one: Arrived) -> VibrationSamples:
        """Samples of a block, by channel."""
        block, names = one.message, tuple(one.message.names)
        found = names, float(block.sample_period)
        if self._channels is None:
            if not names or not 0.0 < found[1] < 1.0:
                raise InputError(
                    f"{one.sender}: {len(names)} names and a sample_period of {found[1]:g} s: must "
                    "be at least 1 and within 0 and 1 s"
                )
            self._channels = found
        if found != self._channels:
            known = self._channels
            raise InputError(
                f"{one.sender}: names and sample_period are {', '.join(names)}, {found[1]:g} s: "
                f"must be {', '.join(known[0])}, {known[1]:g} s as in the blocks before"
            )
        samples = np.asarray(block.samples, dtype=np.float64)
        if len(samples) % len(names):
            raise InputError(
                f"{one.sender}: {len(samples)} samples: must be the same number of each of the "
                f"{len(names)} channels"
            )
        values = samples.reshape(len(names), -1).T
        time = stamp_of(block) + found[1] * np.arange(len(values), dtype=np.float64)
        return VibrationSamples(time, values, *found)


def stamp_of(message: Any) -> float:
    """Stamp of a message [s]."""
    stamp = message.header.stamp
    return float(stamp.sec + 1e-9 * stamp.nanosec)


def _check(sender: str, found: EncoderFormat) -> None:
    if min(found.counts_per_turn) < 1 or not 0.0 < found.period < 1.0:
        raise InputError(
            f"{sender}: counts per turn and period are {_words(found)}: must be at least 1 and "
            "within 0 and 1 s"
        )


def _words(found: EncoderFormat) -> str:
    first, second = found.counts_per_turn
    return f"{first}, {second}, {found.period:g} s"


def _shaft(message: Any, joint: str) -> dict[str, float]:
    """Values of a joint in a message, by interface."""
    names = list(message.joint_names if hasattr(message, "joint_names") else message.name)
    if joint not in names:
        return {}
    place = names.index(joint)
    found = {name: _interface(message, place, name) for name in ("position", *INTERFACES)}
    return {name: value for name, value in found.items() if value is not None}


def _interface(message: Any, place: int, interface: str) -> float | None:
    """Value of an interface of a joint; None if the message does not have it."""
    if hasattr(message, "interface_values"):
        found = message.interface_values[place]
        pairs = zip(found.interface_names, found.values, strict=False)
        return next((float(value) for name, value in pairs if name == interface), None)
    values = getattr(message, interface)
    return float(values[place]) if len(values) > place else None


def _same_channels(one: _Row, other: _Row) -> bool:
    return one.sender == other.sender and [*one.values] == [*other.values]


def _together(rows: list[_Row]) -> Readings:
    """Join rows to one block."""
    columns = {name: np.array([row.values[name] for row in rows]) for name in rows[0].values}
    stamp, arrival = (np.array([row[k] for row in rows]) for k in (1, 2))
    return Readings(stamp, columns, arrival, rows[0].sender)


def _joined(samples: list[EncoderSamples]) -> EncoderSamples:
    """Join samples to one block."""
    return EncoderSamples(
        np.concatenate([one.sample for one in samples]),
        np.concatenate([one.counts for one in samples]),
        samples[0].format,
    )
