"""Decodes records of a file to messages, by the definitions in the file."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from mcap.records import Channel, Message, Schema
from rosbags.typesys.store import Typestore

from ...text.escaping import one_line
from ..container.records import RecordingError
from .definitions import KINDS, OF_PORTS
from .layout import Layout, LayoutError
from .typestore import DefinitionError, types_of

_LONGEST_REASON = 200  # characters


class Described(NamedTuple):
    """A topic, its type, and the types in its definition."""

    topic: str
    kind: str
    types: Typestore


class MessageError(RecordingError):
    """A message of `topic` does not match its definition."""

    def __init__(self, topic: str, text: str) -> None:
        super().__init__(text)
        self.topic = topic


class Topics:
    """The `wanted` topics of one source, given its records in order.

    A topic with a name of the twin but another type is ignored.
    """

    def __init__(self, source: object, wanted: Callable[[str], bool]) -> None:
        self._source = source  # the file, for messages of errors
        self._wanted = wanted
        self._schemas: dict[int, Schema] = {}
        self._channels: dict[int, Described] = {}

    def of(self, record: Any) -> Described | None:
        """The topic if the record is a message of a wanted topic, else None.

        Raises:
            RecordingError: the encoding of a wanted topic is not supported.
        """
        if isinstance(record, Schema):
            self._schemas[record.id] = record
        elif isinstance(record, Channel):
            schema = self._schemas[record.schema_id]
            if self._wanted(record.topic) and _is_of_twin(record.topic, schema.name):
                types = self._types(record, schema)
                self._channels[record.id] = Described(record.topic, schema.name, types)
        elif isinstance(record, Message) and record.channel_id in self._channels:
            return self._channels[record.channel_id]
        return None

    def __contains__(self, channel: int) -> bool:
        """Whether messages of a channel are read, by its number."""
        return channel in self._channels

    def _types(self, channel: Channel, schema: Schema) -> Typestore:
        if schema.encoding != "ros2msg" or channel.message_encoding != "cdr":
            raise RecordingError(
                f"{self._source}: {channel.topic}: encoded as {schema.encoding}/"
                f"{channel.message_encoding}, must be ros2msg/cdr"
            )
        try:
            return types_of(schema.data, schema.name)
        except DefinitionError as reason:
            why = one_line(str(reason), _LONGEST_REASON)
            raise RecordingError(f"{self._source}: {channel.topic}: its definition {why}") from None


class Decoder:
    """Decodes the `wanted` topics of one source, given its records in order."""

    def __init__(self, source: object, wanted: Callable[[str], bool]) -> None:
        self._source = source
        self._topics = Topics(source, wanted)

    def __contains__(self, channel: int) -> bool:
        """Whether messages of a channel are decoded, by its number."""
        return channel in self._topics

    def read(self, record: Any) -> tuple[str, Any] | None:
        """Topic and message if the record is a message of a wanted topic, else None.

        Raises:
            RecordingError: the encoding of a wanted topic is not supported.
            MessageError: a message does not match its definition.
        """
        described = self._topics.of(record)
        if described is None:
            return None
        try:
            return described.topic, described.types.deserialize_cdr(record.data, described.kind)
        except Exception as reason:  # of many kinds: rosbags runs generated code
            why = one_line(_why(described, record.data, reason), _LONGEST_REASON)
            text = f"{self._source}: {described.topic}: a message {why}"
            raise MessageError(described.topic, text) from None


def _why(described: Described, data: bytes, reason: Exception) -> str:
    """The error of a message, with the field if it can be determined."""
    try:
        Layout(described.types.fielddefs, described.kind, data)
    except LayoutError as error:
        return str(error)
    return f"does not match its definition: {reason or type(reason).__name__}"


def _is_of_twin(topic: str, kind: str) -> bool:
    return (KINDS | OF_PORTS).get(topic.rpartition("/")[2], kind) == kind
