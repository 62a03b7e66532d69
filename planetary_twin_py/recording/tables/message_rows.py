"""Messages of a recording as structured arrays, in batches."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from mcap.records import Message

from ..ros2.decode import Described, described_messages
from .message_tables import Rows

MESSAGES = 4096  # per batch, at most
_SIZE = 2**23  # bytes per batch, approximately


def rows_of(
    path: Path, namespace: str, names: Sequence[str], remarks: list[str]
) -> Iterator[tuple[str, list[Rows]]]:
    """Read messages of several topics; those of each channel in the order of their log times.

    Yields:
        Name of the topic, and successive messages: an array for each layout.

    Raises:
        RecordingError: a message does not match its definition.
    """
    wanted = {f"{namespace}/{name}": name for name in names}
    waiting: dict[Described, _Waiting] = {}
    for described, record in described_messages(path, wanted.__contains__, remarks):
        if described not in waiting:  # perhaps of the next file
            yield from _taken(waiting, wanted)
            waiting[described] = _Waiting(described)
        waiting[described].add(record)
        if waiting[described].full:
            yield wanted[described.topic], waiting[described].taken()
    yield from _taken(waiting, wanted)


def _taken(
    waiting: Mapping[Described, _Waiting], wanted: Mapping[str, str]
) -> Iterator[tuple[str, list[Rows]]]:
    """All messages that wait."""
    for described, of_topic in waiting.items():
        if of_topic.messages:
            yield wanted[described.topic], of_topic.taken()


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
