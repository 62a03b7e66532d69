"""Reads measured readings from a recording of ROS 2 topics."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
from mcap.records import Channel, Message, Schema
from rosbags.typesys.store import Typestore

from ...recording.container.records import RecordingError, files_of, records_of
from ...recording.ros2.typestore import types_in
from ..channels.all import CHANNELS
from ..channels.message_types import JOINTS
from ..readings import Readings
from ..sensors import JointNames
from .messages import KINDS, Arrived, Block, MessageReader

BEGIN = np.datetime64(0, "s")  # second 0 of stamps of ROS 2
PART = 0.5  # [s] of messages that are converted together


def read_recording(
    path: Path,
    joints: JointNames,
    scale: Mapping[str, float] | None = None,
    remarks: list[str] | None = None,
) -> list[Block]:
    """Read measured messages in the order in which they were recorded.

    Args:
        path: an MCAP file, or a folder with one or more.
        joints: names of the joints and of the topics.
        scale: factors on readings by channel, for the check of the unit of speeds.
        remarks: a line is appended for each damaged part, which is omitted, and for positions
            that do not belong to the speed of their shaft.

    Returns:
        Readings of each topic and message type in a row, and samples of encoders and vibration, in
        order of arrival.

    Raises:
        ValueError: the file is not a recording, has no message with these joints, or positions show
            that a speed has another unit.
        OSError: the file cannot be read.
    """
    collected = [] if remarks is None else remarks
    reader = MessageReader(joints, scale)
    blocks = [
        block
        for file in files_of(path, collected)
        for part in _split_by_time(_received(file, joints, collected))
        for block in reader.read(part)
    ]
    collected.extend(reader.remarks())
    read = [block for block in blocks if isinstance(block, Readings)]
    shafts = set(CHANNELS) - {"oil_temperature"}
    measured = [block for block in read if shafts & set(block.columns)]
    if measured and not any(np.isfinite(block.time).any() for block in measured):
        raise ValueError(
            f"{path}: all stamps of {measured[0].sender} are 0: header.stamp of the messages was "
            "not set"
        )
    if not measured:
        raise ValueError(
            f"{path}: no JointState or DynamicJointState with the joints {joints.input!r} and "
            f"{joints.output!r} on a topic that ends in {joints.topics!r}"
        )
    return blocks


def _split_by_time(arrived: Iterator[Arrived]) -> Iterator[list[Arrived]]:
    """Split messages into intervals of `PART`."""
    part: list[Arrived] = []
    for message in arrived:
        if part and not abs(message.time - part[0].time) < PART:
            yield part
            part = []
        part.append(message)
    yield part


def _received(file: Path, joints: JointNames, remarks: list[str]) -> Iterator[Arrived]:
    """Measured messages of a file."""
    schemas: dict[int, Schema] = {}
    types: dict[int, tuple[str, str, Typestore]] = {}  # topic and type of a channel
    for record in records_of(file, remarks):
        if isinstance(record, Schema):
            schemas[record.id] = record
        elif isinstance(record, Channel):
            schema = schemas[record.schema_id]
            unwanted = schema.name in JOINTS and not record.topic.endswith(joints.topics)
            if schema.name in KINDS and not unwanted:
                known = types_in(file, record.topic, schema)
                types[record.id] = record.topic, schema.name, known
        elif isinstance(record, Message) and record.channel_id in types:
            topic, kind, typestore = types[record.channel_id]
            try:
                message = typestore.deserialize_cdr(record.data, kind)
            except Exception as reason:  # of many kinds: rosbags runs generated code
                why = str(reason) or type(reason).__name__
                text = f"{file}: {topic}: a message does not match its definition: {why}"
                raise RecordingError(text) from None
            yield Arrived(topic, kind, 1e-9 * record.log_time, message)
