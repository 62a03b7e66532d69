"""Turns records of a file into messages, by the definitions that the file itself carries."""

from __future__ import annotations

import struct
from collections.abc import Callable
from functools import lru_cache
from typing import Any, NamedTuple

from mcap.records import Channel, Message, Schema
from rosbags.serde import SerdeError
from rosbags.typesys import Stores, TypesysError, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from .records import RecordingError


class Described(NamedTuple):
    """A topic, its type, and the types that its definition tells."""

    topic: str
    kind: str
    types: Typestore


class Topics:
    """The topics of one file that are `wanted`, given its records in order."""

    def __init__(self, wanted: Callable[[str], bool]) -> None:
        self._wanted = wanted
        self._schemas: dict[int, Schema] = {}
        self._channels: dict[int, Described] = {}

    def of(self, record: Any) -> Described | None:
        """The topic, where the record is a message of a wanted topic.

        Raises:
            RecordingError: a wanted topic is encoded in a way that cannot be read.
        """
        if isinstance(record, Schema):
            self._schemas[record.id] = record
        elif isinstance(record, Channel):
            if self._wanted(record.topic):
                schema = self._schemas[record.schema_id]
                types = _types(record, schema)
                self._channels[record.id] = Described(record.topic, schema.name, types)
        elif isinstance(record, Message) and record.channel_id in self._channels:
            return self._channels[record.channel_id]
        return None


class Decoder:
    """Decodes the topics of one file that are `wanted`, given its records in order."""

    def __init__(self, wanted: Callable[[str], bool]) -> None:
        self._topics = Topics(wanted)

    def read(self, record: Any) -> tuple[str, Any] | None:
        """Topic and message, where the record is a message of a wanted topic.

        Raises:
            RecordingError: a wanted topic is encoded in a way that cannot be read.
        """
        found = self._topics.of(record)
        if found is None:
            return None
        try:
            return found.topic, found.types.deserialize_cdr(record.data, found.kind)
        except (SerdeError, struct.error, ValueError, IndexError) as reason:
            raise RecordingError(f"{found.topic}: not as the file describes it: {reason}") from None


def _types(channel: Channel, schema: Schema) -> Typestore:
    if schema.encoding != "ros2msg" or channel.message_encoding != "cdr":
        raise RecordingError(
            f"{channel.topic}: encoded as {schema.encoding}/{channel.message_encoding}, "
            "only ros2msg/cdr can be read"
        )
    try:
        return _types_of(schema.data, schema.name)
    except (TypesysError, UnicodeDecodeError):
        raise RecordingError(f"{channel.topic}: its definition cannot be read") from None


@lru_cache(maxsize=32)  # takes 20 ms, and the files of a recording have the same definitions
def _types_of(definition: bytes, name: str) -> Typestore:
    types = get_typestore(Stores.EMPTY)
    types.register(get_types_from_msg(definition.decode(), name))
    return types
