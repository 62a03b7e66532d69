"""The summary at the end of a finished file, with little memory for each of its chunks.

A day of a twin has 200 000 chunks.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
from mcap.records import (
    Channel,
    ChunkIndex,
    Message,
    Metadata,
    MetadataIndex,
    Schema,
    Statistics,
)
from mcap.stream_reader import StreamReader
from numpy.typing import NDArray

from .extent import Extent
from .framing import LONGEST_RECORD
from .integrity import start_of_summary
from .records import section_at, sections_of

Adding = Callable[[int, int, NDArray[np.int64]], None]


class ChunkPlace(NamedTuple):
    """Where a chunk is: positions of the chunk and of its message indexes, and log times [ns]."""

    start: int
    """Log time of its first message."""
    end: int
    """Log time of its last message."""
    place: int
    indexes: int
    """Position of its message indexes."""
    indexes_length: int
    channels: frozenset[int]
    """Channels that its message indexes list."""


class Summary:
    """Contents of a file; `chunks` in the order of the file."""

    def __init__(self) -> None:
        self.schemas: dict[int, Schema] = {}
        self.channels: dict[int, Channel] = {}
        self.counts = Counter[int]()
        """Messages by channel."""
        self.extent = Extent()
        self.chunks: list[ChunkPlace] = []
        self.metadata: list[Metadata] = []

    def add(self, record: object) -> None:
        """Add a record unless it is a message."""
        if isinstance(record, Schema):
            self.schemas[record.id] = record
        elif isinstance(record, Channel):
            self.channels[record.id] = record
        elif isinstance(record, Metadata):
            self.metadata.append(record)


def read_summary(file: Path) -> Summary:
    """Read the summary of a file.

    Raises:
        one of `DAMAGED`: there is none with statistics, channels and chunks, or it is damaged.
    """
    start = start_of_summary(file)
    if start is None:
        raise ValueError("checksum error")
    found, statistics = Summary(), None
    sets: dict[frozenset[int], frozenset[int]] = {}  # so that equal ones are one object
    with file.open("rb") as stream:
        stream.seek(start)
        reader = StreamReader(stream, skip_magic=True, record_size_limit=LONGEST_RECORD)
        for record in reader.records:
            found.add(record)
            if isinstance(record, ChunkIndex):
                found.chunks.append(_place(record, sets))
            elif isinstance(record, Statistics):
                statistics = record
            elif isinstance(record, MetadataIndex):
                for metadata in section_at(file, record.offset):
                    found.add(metadata)
    if statistics is None:
        raise ValueError("no statistics")
    found.chunks.sort(key=lambda chunk: chunk.place)
    without_chunks = statistics.message_count and not found.chunks
    if len(found.channels) < statistics.channel_count or without_chunks:
        raise ValueError("channels or chunks are not listed")
    found.counts.update(statistics.channel_message_counts)
    found.extent = Extent(statistics.message_start_time, statistics.message_end_time)
    return found


def summary_of_records(file: Path, remarks: list[str], add: Adding | None = None) -> Summary:
    """Make a summary of what can be read in a file, with a place for each section of messages.

    Args:
        file: MCAP file.
        remarks: a line is appended for each damaged part.
        add: called with channel, place and log times [ns] of the messages in each section.

    Raises:
        RecordingError: nothing can be read.
    """
    found = Summary()
    for place, records in sections_of(file, remarks):
        times: defaultdict[int, list[int]] = defaultdict(list)
        for record in records:
            found.add(record)
            if isinstance(record, Message):
                times[record.channel_id].append(record.log_time)
        for channel, of_channel in times.items():
            found.counts[channel] += len(of_channel)
            if add is not None:
                add(channel, place, np.array(of_channel, np.int64))
        if times:
            first, last = min(map(min, times.values())), max(map(max, times.values()))
            found.extent.include(first)
            found.extent.include(last)
            found.chunks.append(ChunkPlace(first, last, place, place, 0, frozenset(times)))
    return found


def _place(index: ChunkIndex, sets: dict[frozenset[int], frozenset[int]]) -> ChunkPlace:
    channels = frozenset(index.message_index_offsets)
    return ChunkPlace(
        index.message_start_time,
        index.message_end_time,
        index.chunk_start_offset,
        index.chunk_start_offset + index.chunk_length,
        index.message_index_length,
        sets.setdefault(channels, channels),
    )
