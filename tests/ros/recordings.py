"""Reads recordings without the code that wrote them."""

import contextlib
import zlib
from collections import Counter, defaultdict
from pathlib import Path
from typing import NamedTuple

from mcap.exceptions import McapError
from mcap.reader import make_reader
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


def times_received(file: Path) -> dict[int, list[int]]:
    """Times at which the messages of each channel were received [ns], as they stand in the file."""
    times = defaultdict(list)
    with file.open("rb") as stream:
        for record in StreamReader(stream, emit_chunks=False).records:
            if isinstance(record, Message):
                times[record.channel_id].append(record.log_time)
    return times


def unfinished_states(file: Path) -> list[GearboxState]:
    """The states in an unfinished file."""
    states = []
    channels: dict[int, str] = {}
    with file.open("rb") as stream, contextlib.suppress(McapError, EOFError, zlib.error):
        for record in StreamReader(stream).records:
            if isinstance(record, Channel):
                channels[record.id] = record.topic
            elif isinstance(record, Message) and channels[record.channel_id].endswith("_state"):
                states.append(deserialize_message(record.data, GearboxState))
    return states


class Received(NamedTuple):
    """A topic of a finished bag, in the order of log time."""

    type: str
    type_hash: str
    offered_qos: str
    messages: list[bytes]


def read_all(folder: Path) -> dict[str, Received]:
    """Topics by name, read by MCAP's own reader."""
    topics: dict[str, Received] = {}
    (file,) = folder.glob("*.mcap")
    with file.open("rb") as stream:
        for schema, channel, message in make_reader(stream).iter_messages():
            assert schema is not None
            described = (channel.metadata[k] for k in ("topic_type_hash", "offered_qos_profiles"))
            topic = topics.setdefault(channel.topic, Received(schema.name, *described, []))
            topic.messages.append(message.data)
    return topics
