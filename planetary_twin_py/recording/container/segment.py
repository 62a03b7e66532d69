"""One MCAP file of a recording, of which single chunks are read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection
from pathlib import Path

from mcap.records import Message

from .framing import DAMAGED
from .records import section_at
from .summary import ChunkPlace, read_summary, summary_of_records

Warn = Callable[[str], None]


class Segment:
    """A file and the places of its chunks.

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
        self._topics = {number: channel.topic for number, channel in summary.channels.items()}
        self.chunks, self.extent = summary.chunks, summary.extent
        self.channels = [(c, summary.schemas.get(c.schema_id)) for c in summary.channels.values()]
        """Channels and their schemas; None for a missing one."""
        self.counts = Counter[str]()
        """Messages by topic."""
        for number, count in summary.counts.items():
            self.counts[self._topics[number]] += count

    def read(self, chunk: ChunkPlace) -> list[tuple[str, Message]]:
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
            return []
        messages = (record for record in records if isinstance(record, Message))
        known = (message for message in messages if message.channel_id in self._topics)
        return [(self._topics[message.channel_id], message) for message in known]

    def may_have(self, chunk: ChunkPlace, topics: Collection[str]) -> bool:
        """Whether a chunk has messages of one of these topics, as far as its index tells."""
        indexed = {self._topics[number] for number in chunk.channels}
        return not indexed or not indexed.isdisjoint(topics)
