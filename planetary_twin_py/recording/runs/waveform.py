"""Samples of the vibration: ranges in memory, samples read from the file on demand.

A minute has 18 million samples of each quantity, so a long recording does not fit into memory.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any, Generic, NamedTuple, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from ...run.window import MeshSamples
from ...units.catalogue import MEMBERS, WAVEFORM
from ..container.records import RecordingError, section_at
from ..ros2.decode import Described

QUANTITIES = tuple(WAVEFORM)
Values = dict[str, NDArray[np.float32]]
TimeSpan = tuple[float, float]
"""Start and end in simulated time [s]."""


@dataclass(kw_only=True)
class BlockSamples(ABC):
    """Recorded samples in single precision, with their `time` [s] and `stamp` [ns], (n,).

    `block` holds the index of the first sample of each recorded block.
    """

    time: NDArray[np.float64]
    stamp: NDArray[np.int64]
    block: NDArray[np.int64]

    @classmethod
    @abstractmethod
    def shapes(cls, planets: Any) -> dict[str, tuple[Any, ...]]:
        """Shape of a sample of each quantity, by the number of planets."""


@dataclass(kw_only=True)
class Waveform(MeshSamples, BlockSamples):
    """Samples of every mesh, (n, meshes)."""

    @classmethod
    def shapes(cls, planets: Any) -> dict[str, tuple[Any, ...]]:
        """Shape of a sample of each quantity, by the number of planets."""
        return dict.fromkeys(QUANTITIES, (2 * planets,))


@dataclass(kw_only=True)
class AxesSamples(BlockSamples):
    """Samples of every axis.

    Bodies are sun, ring, carrier, planet_1..N. `displacement` [m] and `bearing_force` [N] are
    (n, bodies, 2) on the carrier, `orbit` [m] of the first three (n, 3, 2) in the housing.
    """

    displacement: NDArray[np.float32]
    bearing_force: NDArray[np.float32]
    orbit: NDArray[np.float32]

    @classmethod
    def shapes(cls, planets: Any) -> dict[str, tuple[Any, ...]]:
        """Shape of a sample of each quantity, by the number of planets."""
        members = len(MEMBERS)
        of_all = dict.fromkeys(("displacement", "bearing_force"), (planets + members, 2))
        return {**of_all, "orbit": (members, 2)}


S = TypeVar("S", bound=BlockSamples)
S_co = TypeVar("S_co", bound=BlockSamples, covariant=True)


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
    """The messages of a topic in a file."""

    file: Path
    channel: int
    described: Described


class Blocks(Protocol[S_co]):
    """The recorded blocks of one gearbox, in memory or in a file."""

    def samples(self, begin: float, end: float) -> S_co | None:
        """Samples of all blocks that overlap the time span [s]; None if there are none."""


class RangedBlocks(Blocks[Waveform], Protocol):
    """The recorded blocks of the waveform, with their ranges."""

    def ranges(self) -> Ranges | None:
        """Ranges of all blocks; None if there are none."""


@dataclass
class InMemory(Generic[S]):
    """Blocks in memory."""

    found: S | None

    def samples(self, begin: float, end: float) -> S | None:
        """Samples of all blocks that overlap the time span [s]; None if there are none."""
        if self.found is None:
            return None
        time, block = self.found.time, self.found.block
        counts = np.diff(np.append(block, len(time)))
        touched = (time[block] <= end) & (time[block + counts - 1] >= begin)
        if not touched.any():
            return None
        rows = np.repeat(touched, counts)
        first = np.cumsum([0, *counts[touched][:-1]])
        columns = {name: getattr(self.found, name)[rows] for name in _columns(self.found)}
        return replace(self.found, block=first, **columns)


class WaveformInMemory(InMemory[Waveform]):
    """Blocks of the waveform in memory."""

    def ranges(self) -> Ranges | None:
        """Ranges of all blocks; None if there are none."""
        if self.found is None:
            return None
        wave, block = self.found, self.found.block
        lowest, highest = (
            {name: reduce.reduceat(getattr(wave, name), block, axis=0) for name in QUANTITIES}
            for reduce in (np.fmin, np.fmax)
        )
        following = np.minimum(block + 1, len(wave.time) - 1)
        period = wave.time[following] - wave.time[block]
        return Ranges(wave.time[block], wave.stamp[block], period, lowest, highest)


class _Stored(NamedTuple):
    """Messages with samples in one section of a file, from `begin` to `end` [s]."""

    source: Source
    place: int
    """Position of the section."""
    begin: float
    end: float


class InFile(Generic[S]):
    """The recorded blocks in a file, in its order.

    Args:
        kind: class of the samples.
    """

    def __init__(self, kind: type[S]) -> None:
        self._kind = kind
        self._stored: list[_Stored] = []

    def add(self, source: Source, place: int, rows: NDArray[Any]) -> None:
        """Add messages from the section at position `place` of a file, all with samples.

        Raises:
            RecordingError: samples are missing in a message.
        """
        for name, shape in self._kind.shapes(rows["planets"].astype(np.int64)).items():
            if (math.prod(shape) * rows["samples"] != rows.dtype[name].shape[0]).any():
                topic = source.described.topic
                raise RecordingError(f"{source.file}: {topic}: samples are missing in a message")
        begin, end = float(rows["start_time"].min()), float(last_times(rows).max())
        self._stored.append(_Stored(source, place, begin, end))

    def samples(self, begin: float, end: float) -> S | None:
        """Samples of all blocks that overlap the time span [s]; None if there are none."""
        return samples_of(self._kind, self._read(begin, end))

    def _read(self, begin: float, end: float) -> Iterator[NDArray[Any]]:
        """Read again the messages whose blocks overlap a time span [s]."""
        overlapping = (part for part in self._stored if part.begin <= end and part.end >= begin)
        for source, place in dict.fromkeys(part[:2] for part in overlapping):
            records = section_at(source.file, place)
            data = [r.data for r in records if getattr(r, "channel_id", None) == source.channel]
            for rows in source.described.arrays(data):
                yield rows[(rows["start_time"] <= end) & (last_times(rows) >= begin)]


class WaveformInFile(InFile[Waveform]):
    """The recorded blocks of the waveform in a file, with their ranges in memory."""

    def __init__(self) -> None:
        super().__init__(Waveform)
        self._ranges: list[Ranges] = []

    def add(self, source: Source, place: int, rows: NDArray[Any]) -> None:
        """Add messages as `InFile.add` does."""
        super().add(source, place, rows)
        meshes = 2 * int(rows["planets"][0])
        lowest, highest = (
            {
                name: end.reduce(rows[name].reshape(len(rows), meshes, -1), axis=2)
                for name in WAVEFORM
            }
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


def samples_of(kind: type[S], messages: Iterable[NDArray[Any]]) -> S | None:
    """The samples of structured arrays of messages; None if there are none.

    Args:
        kind: class of the samples.
        messages: messages of MeshWaveform or AxesWaveform.
    """
    arrays = [rows[rows["samples"] > 0] for rows in messages]
    arrays = [rows for rows in arrays if len(rows)]
    if not arrays:
        return None
    columns = {
        name: np.concatenate(
            [one.reshape(math.prod(shape), -1).T for rows in arrays for one in rows[name]],
            dtype=np.float32,
        ).reshape(-1, *shape)
        for name, shape in kind.shapes(int(arrays[0]["planets"][0])).items()
    }
    counts = np.concatenate([rows["samples"] for rows in arrays]).astype(np.int64)
    start, period, stamp = (
        np.repeat(np.concatenate(parts), counts)
        for parts in (
            [rows["start_time"] for rows in arrays],
            [rows["sample_period"] for rows in arrays],
            [stamps(rows) for rows in arrays],
        )
    )
    first = np.cumsum([0, *counts[:-1]])
    offset = (np.arange(len(start)) - np.repeat(first, counts)) * period
    stamp = stamp + np.rint(offset * 1e9).astype(np.int64)
    return kind(time=start + offset, stamp=stamp, block=first, **columns)


def joined(parts: Iterable[S | None]) -> S | None:
    """Concatenate parts; None if there are none."""
    found = [part for part in parts if part is not None]
    if not found:
        return None
    before = np.cumsum([0, *(len(part.time) for part in found)])
    block = np.concatenate([part.block + n for part, n in zip(found, before, strict=False)])
    columns = {
        name: np.concatenate([getattr(part, name) for part in found]) for name in _columns(found[0])
    }
    return replace(found[0], block=block, **columns)


def stamps(rows: NDArray[Any]) -> NDArray[np.int64]:
    """ROS time of messages [ns]."""
    stamp = rows["header"]["stamp"]
    return np.asarray(stamp["sec"].astype(np.int64) * 1_000_000_000 + stamp["nanosec"])


def _columns(samples: BlockSamples) -> Sequence[str]:
    """Names of the arrays with a row for each sample."""
    return [field.name for field in fields(samples) if field.name != "block"]


def last_times(rows: NDArray[Any]) -> NDArray[np.float64]:
    """Simulated time of the last sample of each message [s]."""
    last = rows["start_time"] + (rows["samples"] - 1.0) * rows["sample_period"]
    return np.asarray(last)
