"""Messages of a recording as structured arrays, in batches."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from mcap.records import Message

from ..container.records import files_of
from ..ros2.decode import Described, Topics
from ..ros2.repeats import Repeats, unrepeated
from .message_tables import Rows

MESSAGES = 4096  # per batch, at most
_SIZE = 2**23  # bytes per batch, approximately


def rows_of(
    path: Path, namespace: str, names: Sequence[str], remarks: list[str]
) -> Iterator[tuple[str, list[Rows]]]:
    """Read messages of several topics; those of each channel in the order of their log times.

    Args:
        path: path of the recording.
        namespace: namespace of the gearbox.
        names: names of the topics, without namespace.
        remarks: warnings are appended.

    Yields:
        Name of the topic, and successive messages: an array for each layout.

    Raises:
        RecordingError: a message does not match its definition.
    """
    wanted = {f"{namespace}/{name}": name for name in names}
    repeats = Repeats()
    for file in files_of(path, remarks):
        waiting: dict[int, _Waiting] = {}
        topics = Topics(file, wanted.__contains__)
        for record in unrepeated(file, remarks, repeats):
            if not (described := topics.of(record)):
                continue
            channel = record.channel_id
            if channel not in waiting:
                waiting[channel] = _Waiting(described)
            of_channel = waiting[channel]
            of_channel.add(record)
            if of_channel.full:
                yield wanted[described.topic], of_channel.taken()
        for of_channel in waiting.values():
            if of_channel.messages:
                yield wanted[of_channel.described.topic], of_channel.taken()


class _Waiting:
    """The next batch of a channel."""

    def __init__(self, described: Described) -> None:
        self.described = described
        self.messages: list[bytes] = []
        self._size = 0

    def add(self, message: Message) -> None:
        self.messages.append(message.data)
        self._size += len(message.data)

    @property
    def full(self) -> bool:
        return len(self.messages) >= MESSAGES or self._size >= _SIZE

    def taken(self) -> list[Rows]:
        """The messages, which no longer wait."""
        messages, self.messages, self._size = self.messages, [], 0
        return list(self.described.arrays(messages))
