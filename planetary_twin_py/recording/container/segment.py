"""One MCAP file of a recording, read from any time: by its chunk index, or sequentially."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Callable, Iterator, Mapping
from itertools import takewhile
from pathlib import Path
from typing import NamedTuple, Protocol

from mcap.records import Channel, Message, Schema

from .extent import Extent
from .framing import DAMAGED
from .log_order import merged, records_in_log_order
from .records import section_at
from .summary import ChunkPlace, Summary, read_summary

Warn = Callable[[str], None]


class Contents(NamedTuple):
    """Contents of a file: channels with their schemas (None if missing), counts, and times."""

    channels: dict[int, tuple[Channel, Schema | None]]
    counts: Counter[str]
    extent: Extent


class Segment(Protocol):
    """A file that can be read from any log time [ns]."""

    contents: Contents

    def messages(self, begin: int) -> Iterator[tuple[str, Message]]:
        """Messages at or after log time `begin` [ns] with their topics, in order of log time."""

    def newest(self, kept: Mapping[str, int], before: int) -> dict[str, list[Message]]:
        """The last `kept[topic]` messages before log time `before` [ns], oldest first."""


def open_segment(file: Path, warn: Warn) -> Segment:
    """Open a file; `warn` is called with a line for each unreadable part, now and later."""
    try:
        summary = read_summary(file)
    except DAMAGED:  # truncated, or the summary fails its checksum
        return _InOrder(file, warn)
    if summary.statistics.message_count and not summary.chunks:
        return _InOrder(file, warn)
    if len(summary.channels) < summary.statistics.channel_count:  # they are not repeated there
        return _InOrder(file, warn)
    return _Indexed(file, summary, warn)


class _Indexed:
    """A finished file, whose summary has an index of the chunks."""

    def __init__(self, file: Path, summary: Summary, warn: Warn) -> None:
        self._file = file
        self._warn = warn
        self._chunks = sorted(summary.chunks)
        self._topics = {number: channel.topic for number, channel in summary.channels.items()}
        self.contents = _contents(summary)

    def messages(self, begin: int) -> Iterator[tuple[str, Message]]:
        parts = ((chunk.start, self._read(chunk)) for chunk in self._chunks if chunk.end >= begin)
        for message in merged(parts):
            if message.log_time >= begin:
                yield self._topics[message.channel_id], message

    def newest(self, kept: Mapping[str, int], before: int) -> dict[str, list[Message]]:
        return {topic: self._last(topic, count, before) for topic, count in kept.items()}

    def _last(self, topic: str, count: int, before: int) -> list[Message]:
        channels = {number for number, name in self._topics.items() if name == topic}
        messages: list[Message] = []
        for chunk in reversed(self._chunks):
            indexed = chunk.channels
            if chunk.start >= before or (indexed and not channels & indexed):
                continue
            matching = [
                message
                for message in self._read(chunk)
                if message.channel_id in channels and message.log_time < before
            ]
            messages = matching + messages
            if len(messages) >= count:
                break
        return messages[-count:]

    def _read(self, chunk: ChunkPlace) -> Iterator[Message]:
        """Messages of a chunk; a damaged chunk is skipped with a warning."""
        try:
            records = section_at(self._file, chunk.place)
        except DAMAGED as reason:
            begin = self.contents.extent.start
            first, last = chunk.start - begin, chunk.end - begin
            self._warn(
                f"{self._file.name}: damaged from {first * 1e-9:.3f} to {last * 1e-9:.3f} s "
                f"({type(reason).__name__}); this part is skipped"
            )
            return
        for record in records:
            if isinstance(record, Message):
                yield record


class _InOrder:
    """A file without an index, truncated or written without chunks; it is read sequentially."""

    def __init__(self, file: Path, warn: Warn) -> None:
        self._file = file
        self._warn = warn
        self.contents = Contents({}, Counter(), Extent())
        schemas: dict[int, Schema] = {}
        for record in self._records():
            if isinstance(record, Schema):
                schemas[record.id] = record
            elif isinstance(record, Channel):
                self.contents.channels[record.id] = record, schemas.get(record.schema_id)
            elif isinstance(record, Message):
                self.contents.extent.include(record.log_time)
                self.contents.counts[self._topic(record)] += 1

    def messages(self, begin: int) -> Iterator[tuple[str, Message]]:
        for record in self._records():
            if isinstance(record, Message) and record.log_time >= begin:
                yield self._topic(record), record

    def newest(self, kept: Mapping[str, int], before: int) -> dict[str, list[Message]]:
        latest = {topic: deque[Message](maxlen=count) for topic, count in kept.items()}
        candidates = takewhile(lambda pair: pair[1].log_time < before, self.messages(0))
        for topic, message in candidates:
            if topic in latest:
                latest[topic].append(message)
        return {topic: list(messages) for topic, messages in latest.items()}

    def _topic(self, message: Message) -> str:
        return self.contents.channels[message.channel_id][0].topic

    def _records(self) -> Iterator[object]:
        remarks: list[str] = []
        yield from records_in_log_order(self._file, remarks)
        for remark in remarks:
            self._warn(remark)


def _contents(summary: Summary) -> Contents:
    statistics = summary.statistics
    extent = Extent()
    if statistics.message_count:
        extent.include(statistics.message_start_time)
        extent.include(statistics.message_end_time)
    counts: Counter[str] = Counter()
    for number, count in statistics.channel_message_counts.items():
        counts[summary.channels[number].topic] += count
    channels = {n: (c, summary.schemas.get(c.schema_id)) for n, c in summary.channels.items()}
    return Contents(channels, counts, extent)
