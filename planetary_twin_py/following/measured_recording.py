"""Reads measured readings from a recording of ROS 2 topics."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from mcap.exceptions import McapError
from mcap.reader import make_reader
from rosbags.typesys.store import Typestore

from ..recording.ros2.typestore import DefinitionError, types_of
from .bins import CHANNELS
from .follower import EncoderSamples, Readings
from .measured_messages import JOINTS, KINDS, Arrived, MessageReader
from .sensors import JointNames

PART = 0.5  # [s] of messages that are converted together


def read_recording(
    path: Path, joints: JointNames, scale: Mapping[str, float] | None = None
) -> list[Readings | EncoderSamples]:
    """Read measured messages in the order in which they were recorded.

    Args:
        path: an MCAP file, or a folder with one or more.
        joints: names of the joints and of the topics.
        scale: factors on readings by channel, for the check of the unit of speeds.

    Returns:
        Readings and encoder samples in blocks, in the order of their arrival.

    Raises:
        ValueError: the file is not a recording, has no message with these joints, or positions show
            that a speed has another unit.
        OSError: the file cannot be read.
    """
    files = sorted(path.glob("*.mcap")) if path.is_dir() else [path]
    if not files:
        raise ValueError(f"{path}: has no .mcap file")
    reader = MessageReader(joints, scale)
    found = [
        block
        for file in files
        for part in _in_parts(_arrived(file, joints))
        for block in reader.read(part)
    ]
    named = (block.columns for block in found if isinstance(block, Readings))
    shafts = set(CHANNELS) - {"oil_temperature"}
    if not any(shafts & set(columns) for columns in named):
        raise ValueError(
            f"{path}: no JointState or DynamicJointState with the joints {joints.input!r} and "
            f"{joints.output!r} on a topic that ends in {joints.topics!r}"
        )
    return found


def _in_parts(arrived: Iterator[Arrived]) -> Iterator[list[Arrived]]:
    """Split messages into intervals of `PART`."""
    part: list[Arrived] = []
    for one in arrived:
        if part and not abs(one.time - part[0].time) < PART:
            yield part
            part = []
        part.append(one)
    yield part


def _arrived(file: Path, joints: JointNames) -> Iterator[Arrived]:
    """Measured messages of a file."""
    types: dict[int, Typestore] = {}
    try:
        with file.open("rb") as stream:
            for schema, channel, message in make_reader(stream).iter_messages():
                kind = schema.name if schema is not None else ""
                joint = kind in JOINTS
                other = joint and not channel.topic.endswith(joints.topics)
                if schema is None or kind not in KINDS or other:
                    continue
                if schema.id not in types:
                    types[schema.id] = types_of(schema.data, kind)
                found = types[schema.id].deserialize_cdr(message.data, kind)
                yield Arrived(channel.topic, kind, 1e-9 * message.log_time, found)
    except (McapError, DefinitionError) as error:
        raise ValueError(f"{file}: is not a readable recording: {error}") from None
