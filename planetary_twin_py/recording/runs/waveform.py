"""Samples of the vibration: ranges in memory, samples read from the file on demand.

A minute has 18 million samples of each quantity, so a long recording does not fit into memory.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from ...run.window import MeshSamples
from ...units.catalogue import WAVEFORM
from ..container.records import RecordingError, section_at
from ..ros2.layout import LayoutError, Layouts

QUANTITIES = tuple(WAVEFORM)
Values = dict[str, NDArray[np.float32]]
TimeSpan = tuple[float, float]
"""Start and end in simulated time [s]."""


@dataclass(kw_only=True)
class Waveform(MeshSamples):
    """Recorded samples, in single precision, with their `stamp` [ns], (n,).

    `block` holds the index of the first sample of each recorded block.
    """

    stamp: NDArray[np.int64]
    block: NDArray[np.int64]


@dataclass
class Ranges:
    """Smallest and largest sample of each recorded block, without NaN.

    `time` [s] and `stamp` [ns] (blocks,) are those of the first sample, `period` [s] is the sample
    period; `lowest[name]` and `highest[name]` have the shape (blocks, meshes), for each of
    `QUANTITIES`.
    """

    time: NDArray[np.float64]
    stamp: NDArray[np.int64]
    period: NDArray[np.float64]
    lowest: Values
    highest: Values


class Source(NamedTuple):
    """The messages of a topic in a file, and their layouts."""

    file: Path
    channel: int
    topic: str
    layouts: Layouts

    def arrays(self, messages: list[bytes]) -> Iterator[NDArray[Any]]:
        """Structured arrays of messages, in order.

        Raises:
            RecordingError: a message does not match its definition.
        """
        try:
            yield from self.layouts.arrays(messages)
        except LayoutError as reason:
            raise RecordingError(f"{self.file}: {self.topic}: a message {reason}") from None


class Stored(NamedTuple):
    """Messages with samples in one section of a file."""

    source: Source
    place: int
    """Position of the section."""
    begin: float
    """Simulated time of the first sample [s]."""
    end: float
    """Simulated time of the last sample [s]."""


class Samples(Protocol):
    """The recorded blocks of one gearbox, in memory or in a file."""

    def ranges(self) -> Ranges | None:
        """Ranges of all blocks; None if there are none."""

    def waveform(self, begin: float, end: float) -> Waveform | None:
        """Samples of all blocks that overlap the time span [s]; None if there are none."""


@dataclass
class InMemory:
    """Blocks in memory."""

    samples: Waveform | None

    def ranges(self) -> Ranges | None:
        """Ranges of all blocks; None if there are none."""
        if self.samples is None:
            return None
        wave, block = self.samples, self.samples.block
        lowest, highest = (
            {name: reduce.reduceat(getattr(wave, name), block, axis=0) for name in QUANTITIES}
            for reduce in (np.fmin, np.fmax)
        )
        following = np.minimum(block + 1, len(wave.time) - 1)
        period = wave.time[following] - wave.time[block]
        return Ranges(wave.time[block], wave.stamp[block], period, lowest, highest)

    def waveform(self, begin: float, end: float) -> Waveform | None:
        """Samples of all blocks that overlap the time span [s]; None if there are none."""
        wave = self.samples
        if wave is None:
            return None
        counts = np.diff(np.append(wave.block, len(wave.time)))
        last = wave.time[wave.block + counts - 1]
        touched = (wave.time[wave.block] <= end) & (last >= begin)
        if not touched.any():
            return None
        rows = np.repeat(touched, counts)
        first = np.concatenate(([0], np.cumsum(counts[touched])))[:-1]
        columns = {name: getattr(wave, name)[rows] for name in QUANTITIES}
        return Waveform(time=wave.time[rows], stamp=wave.stamp[rows], block=first, **columns)


class Blocks:
    """The recorded blocks of one gearbox, in file order."""

    def __init__(self) -> None:
        self._stored: list[Stored] = []
        self._ranges: list[Ranges] = []

    def add(self, source: Source, place: int, rows: NDArray[Any]) -> None:
        """Add messages from the section at position `place` of a file.

        Raises:
            RecordingError: samples are missing in a message.
        """
        rows = rows[rows["samples"] > 0]
        if not len(rows):
            return
        meshes = 2 * rows["planets"].astype(int)
        self._stored.append(stored_at(source, place, rows, dict.fromkeys(QUANTITIES, meshes)))
        lowest, highest = (
            {name: end.reduce(_samples(rows, name), axis=2) for name in QUANTITIES}
            for end in (np.fmin, np.fmax)
        )
        time, period = (rows[name].astype(np.float64) for name in ("start_time", "sample_period"))
        self._ranges.append(Ranges(time, stamps(rows), period, lowest, highest))

    def ranges(self) -> Ranges | None:
        """Ranges of all blocks; None if there are none."""
        if not self._ranges:
            return None
        time, stamp, period = (
            np.concatenate([getattr(each, name) for each in self._ranges])
            for name in ("time", "stamp", "period")
        )
        lowest, highest = (
            {
                name: np.concatenate([getattr(each, end)[name] for each in self._ranges])
                for name in QUANTITIES
            }
            for end in ("lowest", "highest")
        )
        return Ranges(time, stamp, period, lowest, highest)

    def waveform(self, begin: float, end: float) -> Waveform | None:
        """Samples of all blocks that overlap the time span [s]; None if there are none."""
        return waveform_of(list(read_stored(self._stored, begin, end)))


def stored_at(
    source: Source, place: int, rows: NDArray[Any], series: Mapping[str, NDArray[np.int64]]
) -> Stored:
    """Where messages are, to read them again with `read_stored`.

    Args:
        source: topic and file.
        place: position of their section.
        rows: the messages, all with samples.
        series: number of series in each message, by quantity.

    Raises:
        RecordingError: samples are missing in a message.
    """
    if any((n * rows["samples"] != rows.dtype[name].shape[0]).any() for name, n in series.items()):
        raise RecordingError(f"{source.file}: {source.topic}: samples are missing in a message")
    last = rows["start_time"] + (rows["samples"] - 1) * rows["sample_period"]
    return Stored(source, place, float(rows["start_time"].min()), float(last.max()))


def read_stored(stored: Iterable[Stored], begin: float, end: float) -> Iterator[NDArray[Any]]:
    """Read again the messages whose blocks overlap a time span [s]."""
    wanted = {
        (part.source, part.place): None
        for part in stored
        if part.begin <= end and part.end >= begin
    }
    for source, place in wanted:
        records = section_at(source.file, place)
        data = [r.data for r in records if getattr(r, "channel_id", None) == source.channel]
        for rows in source.arrays(data):
            last = rows["start_time"] + (rows["samples"] - 1.0) * rows["sample_period"]
            yield rows[(rows["start_time"] <= end) & (last >= begin) & (rows["samples"] > 0)]


def waveform_of(messages: Iterable[NDArray[Any]]) -> Waveform | None:
    """The samples of structured arrays of MeshWaveform; None if there are none."""
    arrays = [rows[rows["samples"] > 0] for rows in messages]
    arrays = [rows for rows in arrays if len(rows)]
    if not arrays:
        return None
    counts = np.concatenate([rows["samples"] for rows in arrays]).astype(np.int64)
    first = np.concatenate(([0], np.cumsum(counts)))
    columns = {
        name: np.concatenate(
            [mesh.T for rows in arrays for mesh in _samples(rows, name)], dtype=np.float32
        )
        for name in QUANTITIES
    }
    time, stamp = times(arrays)
    return Waveform(time=time, stamp=stamp, block=first[:-1], **columns)


def times(found: Sequence[NDArray[Any]]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Simulated time [s] and stamp [ns] of every sample of structured arrays of messages."""
    counts = np.concatenate([rows["samples"] for rows in found]).astype(np.int64)
    offset = np.concatenate(
        [
            np.arange(count) * period
            for rows in found
            for count, period in zip(rows["samples"], rows["sample_period"], strict=True)
        ]
    )
    start = np.concatenate([rows["start_time"] for rows in found])
    stamp = np.concatenate([stamps(rows) for rows in found])
    return (
        np.repeat(start, counts) + offset,
        np.repeat(stamp, counts) + np.rint(offset * 1e9).astype(np.int64),
    )


def joined(parts: Sequence[Waveform]) -> Waveform | None:
    """Concatenate parts; None if there are none."""
    if not parts:
        return None
    before = np.cumsum([0, *(len(part.time) for part in parts)])
    block = np.concatenate([part.block + n for part, n in zip(parts, before, strict=False)])
    names = ("time", "stamp", *QUANTITIES)
    columns = {name: np.concatenate([getattr(part, name) for part in parts]) for name in names}
    return Waveform(block=block, **columns)


def stamps(rows: NDArray[Any]) -> NDArray[np.int64]:
    """ROS time of messages [ns]."""
    stamp = rows["header"]["stamp"]
    return np.asarray(stamp["sec"].astype(np.int64) * 1_000_000_000 + stamp["nanosec"])


def _samples(rows: NDArray[Any], name: str) -> NDArray[np.float32]:
    """Samples of messages with the same layout, shape (messages, meshes, samples)."""
    return np.asarray(rows[name].reshape(len(rows), 2 * int(rows["planets"][0]), -1))
