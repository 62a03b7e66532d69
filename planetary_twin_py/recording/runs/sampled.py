"""Successive samples of sensors in a recording: an index in memory, samples read on demand.

Blocks that are missing or recorded twice are found by their numbers and stamps, and said; samples
on both sides of a gap are never joined.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np
from mcap.records import Message
from numpy.typing import NDArray

from ..container.records import RecordingError, section_at
from .block_order import PLACE, BlockOrder, Segment, ToTime
from .waveform import Source, stamps

Array = NDArray[np.float64]
_KEPT = 8  # sections, so that neighbours are not unpacked again


class Channels(NamedTuple):
    """The channels of a sensor."""

    names: tuple[str, ...]
    units: tuple[str, ...]


class Found(NamedTuple):
    """Samples of a time span."""

    time: Array
    """[s], (n,)."""
    stamp: NDArray[np.int64]
    """ROS time [ns], (n,)."""
    values: NDArray[np.float32]
    """In the units of the channels, (n, channels)."""


class SampledSensor:
    """The blocks of one topic in the files of a recording."""

    def __init__(self, topic: str) -> None:
        self.topic = topic
        self._channels: Channels | None = None
        self._sources: list[Source] = []
        self._parts: list[NDArray[Any]] = []
        self._ends: list[NDArray[np.float32]] = []  # smallest and largest values
        self._read = lru_cache(_KEPT)(self._section)

    def add(self, source: Source, place: int, messages: Sequence[Message]) -> None:
        """Add messages from the section at position `place` of a file, in the order of log times.

        Raises:
            RecordingError: the channels differ from those before, or samples are missing.
        """
        if source not in self._sources:
            self._sources.append(source)
        number, of_source = 0, self._sources.index(source)
        for rows in source.described.arrays([message.data for message in messages]):
            channels = self._checked(source, rows)
            part = np.zeros(len(rows), PLACE)
            part["sequence"], part["stamp"] = rows["sequence"], stamps(rows)
            part["period"] = rows["sample_period"]
            part["count"] = rows["samples"].shape[1] // len(channels.names)
            part["source"], part["place"] = of_source, place
            part["number"] = number + np.arange(len(rows))
            number += len(rows)
            part["row"] = sum(map(len, self._parts)) + np.arange(len(rows))
            self._parts.append(part)
            values = rows["samples"].reshape(len(rows), len(channels.names), -1)
            self._ends.append(np.stack((values.min(axis=2), values.max(axis=2)), axis=2))

    def _checked(self, source: Source, rows: NDArray[Any]) -> Channels:
        """The channels of messages, which are those of the messages before."""
        where = f"{source.file}: {self.topic}: "
        for texts in dict.fromkeys(
            zip(rows["names"].tolist(), rows["units"].tolist(), strict=True)
        ):
            found = Channels(*(tuple(map(_text, each)) for each in texts))
            before = self._channels or found
            if found != before or len(found.units) != len(found.names) or not found.names:
                raise RecordingError(
                    f"{where}the channels are {_listed(found)}: must be {_listed(before)} as in "
                    "the blocks before, each with its unit"
                )
            self._channels = found
        channels = self.channels
        samples, period = rows["samples"].shape[1], rows["sample_period"]
        if samples % len(channels.names) or not samples:
            raise RecordingError(
                f"{where}{samples} samples: must be the same number of each of the "
                f"{len(channels.names)} channels"
            )
        if not (period > 0.0).all():
            raise RecordingError(f"{where}sample_period = {period.min():g} s: must be above 0")
        return channels

    @property
    def channels(self) -> Channels:
        """Names and units."""
        assert self._channels is not None
        return self._channels

    @cached_property
    def order(self) -> BlockOrder:
        """The blocks in the order of their stamps."""
        return BlockOrder(self.topic, np.concatenate(self._parts))

    @property
    def ranges(self) -> NDArray[np.float32]:
        """Smallest and largest sample of each block and channel, (blocks, channels, 2)."""
        return np.concatenate(self._ends)[self.order.blocks["row"]]

    @property
    def rate(self) -> float:
        """Sample rate of the first block [Hz]."""
        return 1.0 / float(self.order.blocks["period"][0])

    def samples(self, to_time: ToTime, begin: float, end: float) -> Found:
        """Samples of all blocks that overlap a time span; those of a segment have equal steps.

        Args:
            to_time: gives the time axis.
            begin: start [s].
            end: end [s].

        Returns:
            The samples, perhaps none.

        Raises:
            OSError: the file no longer exists.
        """
        parts = [Found(np.empty(0), np.empty(0, np.int64), self._empty)]
        for segment in self.order.segments(to_time):
            starts = segment.time + segment.period * self._before(segment)
            rows = np.flatnonzero((starts[:-1] <= end) & (starts[1:] > begin))
            if len(rows):
                parts.append(self._part(segment, int(rows[0]), int(rows[-1]) + 1))
        return Found(*(np.concatenate(each) for each in zip(*parts, strict=True)))

    def parts(self, to_time: ToTime, most: int) -> Iterator[Found]:
        """All samples in order, of at most `most` blocks at a time.

        Args:
            to_time: gives the time axis.
            most: blocks at a time.
        """
        for segment in self.order.segments(to_time):
            count = segment.end - segment.begin
            for first in range(0, count, most):
                yield self._part(segment, first, min(first + most, count))

    def _part(self, segment: Segment, first: int, last: int) -> Found:
        """Samples of the blocks of a segment from number `first` in it to before `last`."""
        before = self._before(segment)
        blocks = self.order.blocks[segment.begin + first : segment.begin + last]
        numbers = np.arange(before[first], before[last])
        within = numbers - np.repeat(before[first:last], blocks["count"])
        offset = np.rint(1e9 * segment.period * within).astype(np.int64)
        return Found(
            segment.time + segment.period * numbers,
            np.repeat(blocks["stamp"], blocks["count"]) + offset,
            np.concatenate([self._values(block) for block in blocks]),
        )

    def _before(self, segment: Segment) -> NDArray[np.int64]:
        """Samples of a segment before each of its blocks, and before its end."""
        counts = self.order.blocks["count"][segment.begin : segment.end]
        return np.concatenate(([0], np.cumsum(counts)))

    @property
    def _empty(self) -> NDArray[np.float32]:
        return np.empty((0, len(self.channels.names)), np.float32)

    def _values(self, block: Any) -> NDArray[np.float32]:
        """Samples of a block, (n, channels)."""
        flat = self._read(int(block["source"]), int(block["place"]))[int(block["number"])]
        return flat.reshape(len(self.channels.names), -1).T

    def _section(self, source: int, place: int) -> list[NDArray[np.float32]]:
        """Samples of the blocks in a section of a file, in the order of log times."""
        of_source = self._sources[source]
        found = section_at(of_source.file, place)
        records = [r for r in found if getattr(r, "channel_id", None) == of_source.channel]
        records.sort(key=lambda record: record.log_time)
        arrays = of_source.described.arrays([record.data for record in records])
        return [one.astype(np.float32) for rows in arrays for one in rows["samples"]]


def _text(raw: bytes) -> str:
    return raw.rstrip(b"\0").decode(errors="replace")


def _listed(channels: Channels) -> str:
    return ", ".join(f"{n} [{u}]" for n, u in zip(*channels, strict=False)) or "none"
