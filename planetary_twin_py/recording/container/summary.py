"""The summary at the end of a finished file, with little memory for each of its chunks.

A day of a twin has 200 000 chunks.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from mcap.records import Channel, ChunkIndex, Metadata, MetadataIndex, Schema, Statistics
from mcap.stream_reader import StreamReader

from .framing import LONGEST_RECORD
from .integrity import start_of_summary
from .records import section_at


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


class Summary(NamedTuple):
    """The summary of a file; `chunks` in the order of the file."""

    schemas: dict[int, Schema]
    channels: dict[int, Channel]
    statistics: Statistics
    chunks: list[ChunkPlace]
    metadata: list[Metadata]


def read_summary(file: Path) -> Summary:
    """Read the summary of a file.

    Raises:
        one of `DAMAGED`: there is none with statistics, or it is damaged.
    """
    start = start_of_summary(file)
    if start is None:
        raise ValueError("checksum error")
    schemas, channels = dict[int, Schema](), dict[int, Channel]()
    statistics: Statistics | None = None
    chunks, metadata = list[ChunkPlace](), list[Metadata]()
    sets: dict[frozenset[int], frozenset[int]] = {}  # so that equal ones are one object
    with file.open("rb") as stream:
        stream.seek(start)
        reader = StreamReader(stream, skip_magic=True, record_size_limit=LONGEST_RECORD)
        for record in reader.records:
            if isinstance(record, ChunkIndex):
                chunks.append(_place(record, sets))
            elif isinstance(record, Statistics):
                statistics = record
            elif isinstance(record, Schema):
                schemas[record.id] = record
            elif isinstance(record, Channel):
                channels[record.id] = record
            elif isinstance(record, MetadataIndex):
                found = section_at(file, record.offset)
                metadata += [each for each in found if isinstance(each, Metadata)]
    if statistics is None:
        raise ValueError("no statistics")
    chunks.sort(key=lambda chunk: chunk.place)
    return Summary(schemas, channels, statistics, chunks, metadata)


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
