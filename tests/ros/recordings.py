"""Reads recordings without the code that wrote them."""

from __future__ import annotations

import contextlib
import zlib
from collections import Counter
from pathlib import Path

from mcap.exceptions import McapError
from mcap.records import Channel, Message
from mcap.stream_reader import StreamReader
from planetary_twin_msgs.msg import GearboxState
from rclpy.serialization import deserialize_message
from rosbags.rosbag2 import Reader


def counts(folder: Path) -> dict[str, int]:
    """Messages by topic of a finished bag, read by rosbags."""
    with Reader(folder) as reader:
        read = Counter(connection.topic for connection, _, _ in reader.messages())
        assert reader.message_count == sum(read.values())
        return {connection.topic: read[connection.topic] for connection in reader.connections}


def torn_states(file: Path) -> list[GearboxState]:
    """The states in a file that nobody finished."""
    states = []
    channels: dict[int, str] = {}
    with file.open("rb") as stream, contextlib.suppress(McapError, EOFError, zlib.error):
        for record in StreamReader(stream).records:
            if isinstance(record, Channel):
                channels[record.id] = record.topic
            elif isinstance(record, Message) and channels[record.channel_id].endswith("_state"):
                states.append(deserialize_message(record.data, GearboxState))
    return states
