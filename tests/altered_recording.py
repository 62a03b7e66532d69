"""Copies of a recording with altered records, whole by every checksum."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from mcap.records import Attachment, Channel, Message, Metadata, Schema
from mcap.stream_reader import StreamReader
from mcap.writer import Writer

Alter = Callable[[Any], Any]


def string(text: str) -> bytes:
    """A serialised std_msgs/String."""
    data = text.encode() + b"\0"
    return b"\0\1\0\0" + len(data).to_bytes(4, "little") + data


def messages_of(topic: str, data: Callable[[bytes], bytes]) -> Alter:
    """Change the messages of a topic."""
    channels: set[int] = set()

    def alter(record: Any) -> Any:
        if isinstance(record, Channel) and record.topic.endswith(topic):
            channels.add(record.id)
        if isinstance(record, Message) and record.channel_id in channels:
            return replace(record, data=data(record.data))
        return record

    return alter


def rewritten(source: Path, target: Path, alter: Alter) -> Path:
    """A copy of a recording with its records altered, whole by every checksum."""
    with source.open("rb") as stream, target.open("wb") as out:
        writer = Writer(out)
        writer.start("ros2", "altered")
        schemas, channels = {}, {}
        for record in map(alter, StreamReader(stream).records):
            if isinstance(record, Schema):
                schemas[record.id] = writer.register_schema(
                    record.name, record.encoding, record.data
                )
            elif isinstance(record, Channel) and record.id not in channels:
                channels[record.id] = writer.register_channel(
                    record.topic,
                    record.message_encoding,
                    schemas[record.schema_id],
                    record.metadata,
                )
            elif isinstance(record, Message):
                number, times = channels[record.channel_id], (record.log_time, record.publish_time)
                writer.add_message(number, times[0], record.data, times[1], record.sequence)
            elif isinstance(record, Attachment):
                times = record.create_time, record.log_time
                writer.add_attachment(*times, record.name, record.media_type, record.data)
            elif isinstance(record, Metadata):
                writer.add_metadata(record.name, record.metadata)
        writer.finish()
    return target
