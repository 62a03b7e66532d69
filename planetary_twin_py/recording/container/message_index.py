"""Random access to the messages of a finished file, by its index.

The index is used only if the checksums of the whole file are correct.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from mcap.opcode import Opcode
from mcap.reader import make_reader
from mcap.records import Channel, ChunkIndex, Message, Metadata, Schema
from numpy.typing import NDArray

from .framing import DAMAGED
from .integrity import damaged_data, damaged_summary
from .records import MOST_TOPICS, section_at

_HEAD = struct.Struct("<BQHI")  # opcode, length, channel, bytes of entries (MCAP 0, Message Index)
_ENTRY = np.dtype([("log_time", "<u8"), ("offset", "<u8")])
UNSOUND: tuple[type[Exception], ...] = (*DAMAGED, KeyError)
_KEPT = 8  # sections, so that neighbours are not unpacked again


class Index:
    """Index of a finished file: its channels, and `times[channel]` of their messages [ns]."""

    def __init__(self, file: Path) -> None:
        """Read the index of `file`.

        Raises:
            one of `UNSOUND`: there is no index, or it is inconsistent.
        """
        if damaged_summary(file) or damaged_data(file):
            raise ValueError("checksum error")
        with file.open("rb") as stream:
            reader = make_reader(stream)
            summary = reader.get_summary()
            if summary is None or summary.statistics is None:
                raise ValueError("no summary")
            if len(summary.channels) > MOST_TOPICS:
                raise ValueError("too many topics")
            self.schemas: dict[int, Schema] = summary.schemas
            self.channels: dict[int, Channel] = summary.channels
            self.metadata: list[Metadata] = list(reader.iter_metadata())
            entries_of: dict[int, list[tuple[int, NDArray[Any]]]] = {c: [] for c in self.channels}
            for chunk in summary.chunk_indexes:
                for channel, entries in _entries(stream, chunk):
                    entries_of[channel].append((chunk.chunk_start_offset, entries))
            self.times = {c: _joined([e["log_time"] for _, e in f]) for c, f in entries_of.items()}
            self._places = {c: _joined([[p] * len(e) for p, e in f]) for c, f in entries_of.items()}
            counts = summary.statistics.channel_message_counts
            if any(counts.get(c, 0) != len(times) for c, times in self.times.items()):
                raise ValueError("messages are missing in the index")
        self._section = lru_cache(_KEPT)(lambda place: section_at(file, place))

    def message(self, channel: int, number: int) -> Message:
        """Message `number` of a channel, counted from 0 in file order.

        Raises:
            one of `UNSOUND`: the message cannot be read.
        """
        places = self._places[channel]
        first = int(np.searchsorted(places, places[number]))
        messages = [
            record
            for record in self._section(int(places[number]))
            if isinstance(record, Message) and record.channel_id == channel
        ]
        if len(messages) <= number - first:
            raise ValueError("the index lists a message that does not exist")
        return messages[number - first]


def _entries(stream: BinaryIO, chunk: ChunkIndex) -> Iterator[tuple[int, NDArray[Any]]]:
    """Index entries of a chunk, by channel."""
    stream.seek(chunk.chunk_start_offset + chunk.chunk_length)
    data = stream.read(chunk.message_index_length)
    place = 0
    while place < len(data):
        opcode, length, channel, size = _HEAD.unpack_from(data, place)
        if opcode != Opcode.MESSAGE_INDEX or length != size + 6:
            raise ValueError("no message index")
        entries = np.frombuffer(data, _ENTRY, size // _ENTRY.itemsize, place + _HEAD.size)
        times = entries["log_time"]
        if ((times < chunk.message_start_time) | (times > chunk.message_end_time)).any():
            raise ValueError("a time outside the range of the chunk")
        yield channel, entries
        place += _HEAD.size + size


def _joined(parts: list[Any]) -> NDArray[np.int64]:
    return np.concatenate([np.empty(0, np.int64), *(np.asarray(p, np.int64) for p in parts)])
