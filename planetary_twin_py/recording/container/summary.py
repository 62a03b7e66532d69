"""The summary at the end of a finished file, with little memory for each of its chunks.

A day of a twin has 200 000 chunks.
"""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import NamedTuple

from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Channel, ChunkIndex, Metadata, MetadataIndex, Schema, Statistics

from .framing import opened, piece_at
from .integrity import damaged_summary, start_of_summary


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
    if damaged_summary(file):
        raise ValueError("checksum error")
    schemas, channels = dict[int, Schema](), dict[int, Channel]()
    statistics: Statistics | None = None
    chunks, metadata = list[ChunkPlace](), list[Metadata]()
    sets: dict[frozenset[int], frozenset[int]] = {}  # so that equal ones are one object
    with file.open("rb") as stream:
        stream.seek(start_of_summary(file))
        while (piece := piece_at(stream)).opcode != Opcode.FOOTER:
            data = ReadDataStream(BytesIO(piece.content))
            if piece.opcode == Opcode.CHUNK_INDEX:
                chunks.append(_place(ChunkIndex.read(data), sets))
            elif piece.opcode == Opcode.STATISTICS:
                statistics = Statistics.read(data)
            elif piece.opcode == Opcode.SCHEMA:
                (schema,) = opened(piece)
                schemas[schema.id] = schema
            elif piece.opcode == Opcode.CHANNEL:
                (channel,) = opened(piece)
                channels[channel.id] = channel
            elif piece.opcode == Opcode.METADATA_INDEX:
                here = stream.tell()
                stream.seek(MetadataIndex.read(data).offset)
                metadata += opened(piece_at(stream))
                stream.seek(here)
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
