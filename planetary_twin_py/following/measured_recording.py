"""Reads measured readings from a recording: joint states and oil temperature on ROS 2 topics."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from mcap.exceptions import McapError
from mcap.reader import make_reader
from rosbags.typesys.store import Typestore

from ..recording.ros2.typestore import DefinitionError, types_of
from .follower import Readings
from .sensors import JointNames

JOINTS = ("sensor_msgs/msg/JointState", "control_msgs/msg/DynamicJointState")
TEMPERATURE = "sensor_msgs/msg/Temperature"
ZERO_CELSIUS = 273.15  # [K]
_INTERFACES = {"velocity": "speed", "effort": "torque"}
_QUANTITIES = {f"{side}_{name}" for side in ("input", "output") for name in _INTERFACES.values()}


def read_recording(path: Path, joints: JointNames) -> list[Readings]:
    """Read measured messages in the order in which they were recorded.

    Temperatures are in degrees Celsius, as sensor_msgs defines them. Fields that a message leaves
    empty, and NaN, are missing readings.

    Args:
        path: an MCAP file, or a folder with one or more.
        joints: names of the joints and of the topics.

    Returns:
        Readings of each topic and message type in a row, in order of arrival.

    Raises:
        ValueError: the file is not a recording, or has no message with these joints.
        OSError: the file cannot be read.
    """
    files = sorted(path.glob("*.mcap")) if path.is_dir() else [path]
    if not files:
        raise ValueError(f"{path}: has no .mcap file")
    rows: list[tuple[str, float, float, dict[str, float]]] = []
    for file in files:
        rows += _rows(file, joints)
    if not any(name in values for *_, values in rows for name in _QUANTITIES):
        raise ValueError(
            f"{path}: no JointState or DynamicJointState with the joints {joints.input!r} and "
            f"{joints.output!r} on a topic that ends in {joints.topics!r}"
        )
    return list(_in_rows(rows))


def _rows(file: Path, joints: JointNames) -> Iterator[tuple[str, float, float, dict[str, float]]]:
    """Sender, stamp, arrival and readings of each message."""
    types: dict[int, Typestore] = {}
    try:
        with file.open("rb") as stream:
            for schema, channel, message in make_reader(stream).iter_messages():
                kind = schema.name if schema is not None else ""
                known = kind in JOINTS and channel.topic.endswith(joints.topics)
                if schema is None or not (known or kind == TEMPERATURE):
                    continue
                if schema.id not in types:
                    types[schema.id] = types_of(schema.data, kind)
                found: Any = types[schema.id].deserialize_cdr(message.data, kind)
                values = _temperature(found) if kind == TEMPERATURE else _joints(found, joints)
                if values:
                    stamp = found.header.stamp
                    yield (
                        channel.topic, stamp.sec + 1e-9 * stamp.nanosec,
                        1e-9 * message.log_time, values,
                    )  # fmt: skip
    except (McapError, DefinitionError) as error:
        raise ValueError(f"{file}: is not a readable recording: {error}") from None


def _temperature(message: Any) -> dict[str, float]:
    return {"oil_temperature": float(message.temperature) + ZERO_CELSIUS}


def _joints(message: Any, joints: JointNames) -> dict[str, float]:
    """Readings of both shafts in a message."""
    names = list(message.joint_names if hasattr(message, "joint_names") else message.name)
    values = {}
    for side, joint in (("input", joints.input), ("output", joints.output)):
        if joint not in names:
            continue
        place = names.index(joint)
        for interface, quantity in _INTERFACES.items():
            value = _interface(message, place, interface)
            if value is not None:
                values[f"{side}_{quantity}"] = value
    return values


def _interface(message: Any, place: int, interface: str) -> float | None:
    """Value of an interface of a joint; None if the message does not have it."""
    if hasattr(message, "interface_values"):
        found = message.interface_values[place]
        pairs = zip(found.interface_names, found.values, strict=False)
        return next((float(value) for name, value in pairs if name == interface), None)
    values = getattr(message, interface)
    return float(values[place]) if len(values) > place else None


def _in_rows(
    rows: list[tuple[str, float, float, dict[str, float]]],
) -> Iterator[Readings]:
    """Readings that follow one another with the same sender and channels, together."""
    begin = 0
    for n in range(1, len(rows) + 1):
        same = n < len(rows) and (rows[n][0], [*rows[n][3]]) == (
            rows[begin][0], [*rows[begin][3]],
        )  # fmt: skip
        if same:
            continue
        part = rows[begin:n]
        columns = {
            name: np.array([values[name] for _, _, _, values in part]) for name in part[0][3]
        }
        stamp, arrival = (np.array([row[k] for row in part]) for k in (1, 2))
        yield Readings(stamp, columns, arrival, part[0][0])
        begin = n
