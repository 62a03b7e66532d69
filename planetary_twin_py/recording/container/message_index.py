"""Random access to the messages of a file, with some bytes for each chunk and channel.

The index in a finished file is used only if the checksums of the whole file are correct.
"""

from __future__ import annotations

import struct
from array import array
from bisect import bisect_right
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import BinaryIO

import numpy as np
from mcap.records import Message
from numpy.typing import NDArray

from .framing import DAMAGED
from .integrity import damaged_data
from .records import section_at
from .summary import ChunkPlace, Summary, read_summary, summary_of_records

_HEAD = struct.Struct("<9xHI")  # channel, bytes of entries (MCAP 0, Message Index)
_ENTRY = np.dtype([("log_time", "<u8"), ("offset", "<u8")])
UNSOUND: tuple[type[Exception], ...] = (*DAMAGED, KeyError)
_KEPT = 8  # sections, so that neighbours are not unpacked again


@dataclass
class LogTimes:
    """Number of messages, their first and last log time, and the longest gap between two [ns]."""

    recorded: int = 0
    first: int = 0
    last: int = 0
    longest_gap: int = 0
    """Longest time between two messages [ns]."""

    def add(self, times: Sequence[int] | NDArray[np.int64]) -> None:
        """Count messages by their log times, which follow those of previous calls."""
        if not len(times):
            return
        before = self.last if self.recorded else int(times[0])
        newest = np.maximum.accumulate(np.concatenate(([before], times)))
        gap = int((times - newest[:-1]).max())
        self.join(LogTimes(len(times), int(np.min(times)), int(newest[-1]), gap))

    def join(self, following: LogTimes) -> None:
        """Add following messages."""
        if not following.recorded:
            return
        if not self.recorded:
            self.first = self.last = following.first
        self.first = min(self.first, following.first)
        between = following.first - self.last
        self.longest_gap = max(self.longest_gap, following.longest_gap, between)
        self.last = max(self.last, following.last)
        self.recorded += following.recorded


@dataclass
class _Chunks:
    """The chunks with messages of one channel, and how many messages are before each."""

    places: array[int] = field(default_factory=lambda: array("q"))
    before: array[int] = field(default_factory=lambda: array("q"))


class Index:
    """A `summary` of a file, and `times[channel]` of the messages."""

    def __init__(self, file: Path) -> None:
        self.summary = Summary()
        self.times: defaultdict[int, LogTimes] = defaultdict(LogTimes)
        self._chunks: defaultdict[int, _Chunks] = defaultdict(_Chunks)
        self._section = lru_cache(_KEPT)(lambda place: section_at(file, place))

    @classmethod
    def of_summary(cls, file: Path) -> Index:
        """Use the index in `file`.

        Raises:
            one of `UNSOUND`: there is no index, or it is inconsistent.
        """
        index = cls(file)
        index.summary = summary = read_summary(file)
        if damaged_data(file):
            raise ValueError("checksum error")
        with file.open("rb") as stream:
            for chunk in summary.chunks:
                for channel, times in _entries(stream, chunk):
                    index._add(channel, chunk.place, times)
        if any(summary.counts[c] != index.times[c].recorded for c in summary.channels):
            raise ValueError("messages are missing in the index")
        return index

    @classmethod
    def of_records(cls, file: Path, remarks: list[str]) -> Index:
        """Read all of `file`; a line is appended to `remarks` for each damaged part.

        Raises:
            RecordingError: nothing can be read.
        """
        index = cls(file)
        index.summary = summary_of_records(file, remarks, index._add)
        return index

    def message(self, channel: int, number: int) -> Message:
        """Message `number` of a channel, counted from 0 in file order.

        Raises:
            one of `UNSOUND`: the message cannot be read.
        """
        chunks = self._chunks[channel]
        chunk = bisect_right(chunks.before, number) - 1
        within = number - chunks.before[chunk]
        messages = [
            record
            for record in self._section(chunks.places[chunk])
            if isinstance(record, Message) and record.channel_id == channel
        ]
        if len(messages) <= within:
            raise ValueError("the index lists a message that does not exist")
        return messages[within]

    def _add(self, channel: int, place: int, times: NDArray[np.int64]) -> None:
        """Add the messages of a channel in the section at `place`, by their log times."""
        self._chunks[channel].places.append(place)
        self._chunks[channel].before.append(self.times[channel].recorded)
        self.times[channel].add(times)


def _entries(stream: BinaryIO, chunk: ChunkPlace) -> Iterator[tuple[int, NDArray[np.int64]]]:
    """Log times of the index entries of a chunk, by channel."""
    stream.seek(chunk.indexes)
    data = stream.read(chunk.indexes_length)
    place = 0
    while place < len(data):
        channel, size = _HEAD.unpack_from(data, place)
        entries = np.frombuffer(data, _ENTRY, size // _ENTRY.itemsize, place + _HEAD.size)
        if len(entries):
            yield channel, entries["log_time"].astype(np.int64)
        place += _HEAD.size + size
