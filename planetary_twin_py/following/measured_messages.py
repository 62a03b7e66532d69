"""Converts ROS 2 messages, live or recorded, to readings and encoder samples.

Empty fields of a message, and NaN, are missing readings. Temperatures are in degrees Celsius, as
sensor_msgs defines them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from .checks import InputError
from .follower import EncoderFormat, EncoderSamples, Readings
from .message_types import ENCODERS, JOINTS, TEMPERATURE, VIBRATION
from .position_check import PositionCheck
from .sensors import JointNames
from .vibration import VibrationSamples

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
        self._unset: dict[str, int] = {}  # messages whose stamp is 0, by sender
        self._first_number: int | None = None  # of a device's sample 0, in periods since time 0
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
        for received in arrived:
            if received.kind == ENCODERS:
                samples.append(self._encoder_samples(received))
                continue
            if received.kind == VIBRATION:
                vibration.append(self._vibration_samples(received))
                continue
            values = self._shaft_readings(received)
            if values:
                row = _Row(received.sender, self._stamp(received), received.time, values)
                if rows and not _same_channels(rows[-1], row):
                    yield _join_rows(rows)
                    rows = []
                rows.append(row)
        if rows:
            yield _join_rows(rows)
        if samples:
            yield _join_samples(samples)
        if vibration:
            yield vibration[0]._replace(
                time=np.concatenate([block.time for block in vibration]),
                values=np.concatenate([block.values for block in vibration]),
            )

    def remarks(self) -> Iterator[str]:
        """A line for each sender without stamps, and for positions unlike the speed of a shaft."""
        for sender, count in self._unset.items():
            yield (
                f"{sender}: {count} messages have the stamp 0, as header.stamp was not set: they "
                "are not used"
            )
        for check in self._positions.values():
            yield from check.remarks()

    def _stamp(self, received: Arrived) -> float:
        """Stamp of a message [s]; NaN where it is 0, which means that it was not set."""
        stamp = stamp_of(received.message)
        if stamp == 0.0:
            self._unset[received.sender] = self._unset.get(received.sender, 0) + 1
            return math.nan
        return stamp

    def _shaft_readings(self, received: Arrived) -> dict[str, float]:
        if received.kind == TEMPERATURE:
            return {"oil_temperature": float(received.message.temperature) + ZERO_CELSIUS}
        values: dict[str, float] = {}
        for side, joint in zip(SIDES, (self._joints.input, self._joints.output), strict=True):
            joint_values = _joint_values(received.message, joint)
            values |= {
                f"{side}_{INTERFACES[name]}": joint_values[name]
                for name in INTERFACES
                if name in joint_values
            }
            if "position" in joint_values and "velocity" in joint_values:
                stamp = stamp_of(received.message)
                self._positions[side].add(stamp, joint_values["position"], joint_values["velocity"])
        return values

    def _encoder_samples(self, received: Arrived) -> EncoderSamples:
        """Return the samples of a block, numbered from time 0 of the stamps."""
        block = received.message
        counts = np.array([block.input_counts, block.output_counts], dtype=np.int64)
        encoder_format = EncoderFormat(
            (int(block.input_counts_per_turn), int(block.output_counts_per_turn)),
            float(block.sample_period),
        )
        if self._format is None:
            _check_format(received.sender, encoder_format)
            self._format = encoder_format
        if encoder_format != self._format:
            raise InputError(
                f"{received.sender}: counts per turn and period are "
                f"{_format_text(encoder_format)}: must be {_format_text(self._format)} as in the "
                "blocks before"
            )
        begin = round(stamp_of(block) / encoder_format.period)
        first = int(block.first_sample)
        deviation = 0 if self._first_number is None else abs(self._first_number + first - begin)
        if self._first_number is None or deviation * encoder_format.period > SET:
            self._first_number = begin - first
        return EncoderSamples(
            self._first_number + first + np.arange(counts.shape[1], dtype=np.int64),
            counts.T,
            encoder_format,
        )

    def _vibration_samples(self, received: Arrived) -> VibrationSamples:
        """Samples of a block, by channel."""
        block, names = received.message, tuple(received.message.names)
        channels = names, float(block.sample_period)
        if self._channels is None:
            if not names or not 0.0 < channels[1] < 1.0:
                raise InputError(
                    f"{received.sender}: {len(names)} names and a sample_period of "
                    f"{channels[1]:g} s: must be at least 1 and within 0 and 1 s"
                )
            self._channels = channels
        if channels != self._channels:
            expected = self._channels
            raise InputError(
                f"{received.sender}: names and sample_period are {', '.join(names)}, "
                f"{channels[1]:g} s: must be {', '.join(expected[0])}, {expected[1]:g} s as in the "
                "blocks before"
            )
        samples = np.asarray(block.samples, dtype=np.float64)
        if len(samples) % len(names):
            raise InputError(
                f"{received.sender}: {len(samples)} samples: must be the same number of each of "
                f"the {len(names)} channels"
            )
        values = samples.reshape(len(names), -1).T
        time = stamp_of(block) + channels[1] * np.arange(len(values), dtype=np.float64)
        return VibrationSamples(time, values, *channels)


def stamp_of(message: Any) -> float:
    """Stamp of a message [s]."""
    stamp = message.header.stamp
    return float(stamp.sec + 1e-9 * stamp.nanosec)


def _check_format(sender: str, encoder_format: EncoderFormat) -> None:
    if min(encoder_format.counts_per_turn) < 1 or not 0.0 < encoder_format.period < 1.0:
        raise InputError(
            f"{sender}: counts per turn and period are {_format_text(encoder_format)}: must be at "
            "least 1 and within 0 and 1 s"
        )


def _format_text(encoder_format: EncoderFormat) -> str:
    first, second = encoder_format.counts_per_turn
    return f"{first}, {second}, {encoder_format.period:g} s"


def _joint_values(message: Any, joint: str) -> dict[str, float]:
    """Values of a joint in a message, by interface."""
    names = list(message.joint_names if hasattr(message, "joint_names") else message.name)
    if joint not in names:
        return {}
    joint_index = names.index(joint)
    values = {
        name: _interface_value(message, joint_index, name) for name in ("position", *INTERFACES)
    }
    return {name: value for name, value in values.items() if value is not None}


def _interface_value(message: Any, joint_index: int, interface: str) -> float | None:
    """Value of an interface of a joint; None if the message does not have it."""
    if hasattr(message, "interface_values"):
        interfaces = message.interface_values[joint_index]
        pairs = zip(interfaces.interface_names, interfaces.values, strict=False)
        return next((float(value) for name, value in pairs if name == interface), None)
    values = getattr(message, interface)
    return float(values[joint_index]) if len(values) > joint_index else None


def _same_channels(first: _Row, second: _Row) -> bool:
    return first.sender == second.sender and [*first.values] == [*second.values]


def _join_rows(rows: list[_Row]) -> Readings:
    """Join rows to one block."""
    columns = {name: np.array([row.values[name] for row in rows]) for name in rows[0].values}
    stamp, arrival = (np.array([row[k] for row in rows]) for k in (1, 2))
    return Readings(stamp, columns, arrival, rows[0].sender)


def _join_samples(samples: list[EncoderSamples]) -> EncoderSamples:
    """Join samples to one block."""
    return EncoderSamples(
        np.concatenate([block.sample for block in samples]),
        np.concatenate([block.counts for block in samples]),
        samples[0].format,
    )
