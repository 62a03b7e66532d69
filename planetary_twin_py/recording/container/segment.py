"""One MCAP file of a recording, read from any time by an index of its chunks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from mcap.records import Message

from .framing import DAMAGED
from .records import section_at
from .summary import ChunkPlace, read_summary, summary_of_records

Warn = Callable[[str], None]


class Segment:
    """A file that can be read from any log time [ns].

    Args:
        file: the file.
        warn: called with a line for each unreadable part, now and later.
    """

    def __init__(self, file: Path, warn: Warn) -> None:
        try:
            summary = read_summary(file)
        except DAMAGED:  # or truncated, or written without chunks
            remarks: list[str] = []
            summary = summary_of_records(file, remarks)
            for remark in remarks:
                warn(remark)
        self._file = file
        self._warn = warn
        self.chunks = sorted(summary.chunks)
        """Places of the chunks, in order of log time."""
        self._topics = {number: channel.topic for number, channel in summary.channels.items()}
        self.extent = summary.extent
        self.channels = [(c, summary.schemas.get(c.schema_id)) for c in summary.channels.values()]
        """Channels and their schemas; None for a missing one."""
        self.counts = Counter[str]()
        """Messages by topic."""
        for number, count in summary.counts.items():
            self.counts[self._topics[number]] += count

    def read(self, chunk: ChunkPlace) -> Iterator[tuple[str, Message]]:
        """Messages of a chunk with their topics; a damaged chunk is skipped with a warning."""
        try:
            records = section_at(self._file, chunk.place)
        except DAMAGED as reason:
            begin = self.extent.start
            first, last = chunk.start - begin, chunk.end - begin
            self._warn(
                f"{self._file.name}: damaged from {first * 1e-9:.3f} to {last * 1e-9:.3f} s "
                f"({type(reason).__name__}); this part is skipped"
            )
            return
        for record in records:
            if isinstance(record, Message) and record.channel_id in self._topics:
                yield self._topics[record.channel_id], record

    def newest(self, kept: Mapping[str, int], before: int) -> dict[str, list[Message]]:
        """The last `kept[topic]` messages before log time `before` [ns], oldest first."""
        return {topic: self._last(topic, count, before) for topic, count in kept.items()}

    def _last(self, topic: str, count: int, before: int) -> list[Message]:
        channels = {number for number, name in self._topics.items() if name == topic}
        messages: list[Message] = []
        for chunk in reversed(self.chunks):
            indexed = chunk.channels
            if len(messages) >= count:
                break
            if chunk.start < before and (not indexed or channels & indexed):
                found = (message for name, message in self.read(chunk) if name == topic)
                messages = [each for each in found if each.log_time < before] + messages
        return messages[-count:]
