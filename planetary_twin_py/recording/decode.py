"""Turns records of a file into messages, by the definitions that the file itself carries."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mcap.records import Channel, Message, Schema
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from .records import RecordingError


class Topics:
    """The topics of one file that are `wanted`, given its records in order.

    `types` are those of the definitions met so far.
    """

    def __init__(self, wanted: Callable[[str], bool]) -> None:
        self._wanted = wanted
        self.types = get_typestore(Stores.EMPTY)
        self._schemas: dict[int, Schema] = {}
        self._channels: dict[int, Channel] = {}

    def of(self, record: Any) -> tuple[str, str] | None:
        """Topic and type, where the record is a message of a wanted topic.

        Raises:
            RecordingError: a wanted topic is encoded in a way that cannot be read.
        """
        if isinstance(record, Schema):
            self._schemas[record.id] = record
        elif isinstance(record, Channel):
            if self._wanted(record.topic):
                self._channels[record.id] = record
                self._learn(record)
        elif isinstance(record, Message) and record.channel_id in self._channels:
            channel = self._channels[record.channel_id]
            return channel.topic, self._schemas[channel.schema_id].name
        return None

    def _learn(self, channel: Channel) -> None:
        schema = self._schemas[channel.schema_id]
        if schema.encoding != "ros2msg" or channel.message_encoding != "cdr":
            raise RecordingError(
                f"{channel.topic}: encoded as {schema.encoding}/{channel.message_encoding}, "
                "only ros2msg/cdr can be read"
            )
        found = get_types_from_msg(schema.data.decode(), schema.name)
        self.types.register({k: v for k, v in found.items() if k not in self.types.types})


class Decoder:
    """Decodes the topics of one file that are `wanted`, given its records in order."""

    def __init__(self, wanted: Callable[[str], bool]) -> None:
        self._topics = Topics(wanted)

    def read(self, record: Any) -> tuple[str, Any] | None:
        """Topic and message, where the record is a message of a wanted topic.

        Raises:
            RecordingError: a wanted topic is encoded in a way that cannot be read.
        """
        if found := self._topics.of(record):
            topic, kind = found
            return topic, self._topics.types.deserialize_cdr(record.data, kind)
        return None
