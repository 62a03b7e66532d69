"""Decodes records of a file to messages, by the definitions in the file."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Sequence
from pathlib import Path
from typing import Any

from mcap.records import Channel, Message, Schema
from numpy.typing import NDArray
from rosbags.typesys.store import Typestore

from ...text.escaping import one_line
from ..container.records import RecordingError, files_of
from .definitions import KINDS, OF_PORTS
from .layout import LayoutError, Layouts
from .repeats import Repeats, unrepeated
from .typestore import LONGEST_REASON, types_in


class Described:
    """A topic with its definition in a source.

    Args:
        source: the file, for messages of errors.
        topic: name of the topic.
        kind: its type.
        types: the types in its definition.
    """

    def __init__(self, source: object, topic: str, kind: str, types: Typestore) -> None:
        self.topic, self.kind = topic, kind
        self.fields = [name for name, _ in types.fielddefs[kind][1]]
        """Names of the fields of a message."""
        self._source, self._types = source, types
        self._layouts = Layouts(types.fielddefs, kind)

    def message(self, data: bytes) -> Any:
        """Decode a message.

        Raises:
            RecordingError: it does not match its definition.
        """
        try:
            return self._types.deserialize_cdr(data, self.kind)
        except Exception as reason:  # of many kinds: rosbags runs generated code
            list(self.arrays([data]))  # whose error names the field, if it can be determined
            text = f"does not match its definition: {reason or type(reason).__name__}"
            raise self._error(text) from None

    def arrays(self, messages: Sequence[bytes]) -> Iterator[NDArray[Any]]:
        """Structured arrays of messages in order, each of messages with the same layout.

        Raises:
            RecordingError: a message does not match its definition.
        """
        try:
            yield from self._layouts.arrays(messages)
        except LayoutError as reason:
            raise self._error(str(reason)) from None

    def _error(self, reason: str) -> RecordingError:
        why = one_line(reason, LONGEST_REASON)
        return RecordingError(f"{self._source}: {self.topic}: a message {why}")


class Topics:
    """The `wanted` topics of one source, and all of some `types`, given its records in order.

    A topic with a name of the twin but another type is ignored.
    """

    def __init__(
        self, source: object, wanted: Callable[[str], bool], types: Container[str] = ()
    ) -> None:
        self._source = source  # the file, for messages of errors
        self._wanted = wanted
        self._whole_types = types
        self._schemas: dict[int, Schema] = {}
        self.by_channel: dict[int, Described] = {}
        """The topics that are wanted, by the number of the channel."""

    def of(self, record: Any) -> Described | None:
        """The topic if the record is a message of a wanted topic, else None.

        Raises:
            RecordingError: the encoding of a wanted topic is not supported.
        """
        if isinstance(record, Schema):
            self._schemas[record.id] = record
        elif isinstance(record, Channel):
            schema = self._schemas[record.schema_id]
            name = record.topic.rpartition("/")[2]
            is_of_twin = (KINDS | OF_PORTS).get(name, schema.name) == schema.name
            is_wanted = self._wanted(record.topic) or schema.name in self._whole_types
            if is_wanted and is_of_twin and record.id not in self.by_channel:
                types = self._types(record, schema)
                described = Described(self._source, record.topic, schema.name, types)
                self.by_channel[record.id] = described
        elif isinstance(record, Message):
            return self.by_channel.get(record.channel_id)
        return None

    def _types(self, channel: Channel, schema: Schema) -> Typestore:
        if schema.encoding != "ros2msg" or channel.message_encoding != "cdr":
            raise RecordingError(
                f"{self._source}: {channel.topic}: encoded as {schema.encoding}/"
                f"{channel.message_encoding}, must be ros2msg/cdr"
            )
        return types_in(self._source, channel.topic, schema)


def described_messages(
    path: Path, wanted: Callable[[str], bool], remarks: list[str]
) -> Iterator[tuple[Described, Message]]:
    """Messages of the wanted topics of a bag, each once, in the order of log times of each file.

    Args:
        path: path of the recording.
        wanted: whether a topic is read, by its name.
        remarks: warnings are appended.

    Raises:
        RecordingError: nothing can be read.
    """
    repeats = Repeats()
    for file in files_of(path, remarks):
        topics = Topics(file, wanted)
        for record in unrepeated(file, remarks, repeats):
            if described := topics.of(record):
                yield described, record
