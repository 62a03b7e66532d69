"""Joins the blocks of one topic, `SampledBlock`, to channels with times."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...text.escaping import one_line
from ..container.records import RecordingError
from .given_channel import Array, Channel

GAP = 0.5  # [steps] by which a block may begin later or earlier than the one before ends


class Blocks:
    """The blocks of one topic.

    Args:
        topic: its name.
    """

    def __init__(self, topic: str) -> None:
        self._topic = topic
        self._names: tuple[str, ...] = ()
        self._units: tuple[str, ...] = ()
        self._period = 0.0
        self._stamps: list[int] = []  # [ns]
        self._values: list[Array] = []

    def add(self, block: Any) -> None:
        """Append a block; one that is repeated is left out.

        Args:
            block: the message.

        Raises:
            RecordingError: it has other channels than the one before, or none.
        """
        names, units = tuple(block.names), tuple(block.units)
        period, samples = float(block.sample_period), np.asarray(block.samples, dtype=np.float64)
        if not names or len(units) != len(names) or not 0.0 < period < np.inf:
            raise self._error(
                f"{len(names)} names, {len(units)} units, sample_period = {period:g} s"
            )
        if self._names and (names, units, period) != (self._names, self._units, self._period):
            raise self._error("has other names, units or another sample_period than before")
        if len(samples) % len(names):
            raise self._error(f"{len(samples)} samples for {len(names)} channels")
        self._names, self._units, self._period = names, units, period
        stamp = block.header.stamp
        nanoseconds = int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)
        if nanoseconds not in self._stamps[-1:]:
            self._stamps.append(nanoseconds)
            self._values.append(samples.reshape(len(names), -1))

    @property
    def first(self) -> int:
        """The earliest stamp [ns]."""
        return min(self._stamps)

    def channels(self, begin: int) -> list[Channel]:
        """The channels in the order of time.

        Args:
            begin: stamp at which their time is 0 [ns].
        """
        order = np.argsort(np.array(self._stamps, dtype=np.int64), kind="stable")
        lengths = [self._values[k].shape[1] for k in order]
        begins = np.array([1e-9 * (self._stamps[k] - begin) for k in order])
        time = np.concatenate(
            [
                begin + self._period * np.arange(length)
                for begin, length in zip(self._joined(begins, lengths), lengths, strict=True)
            ]
        )
        values = np.concatenate([self._values[k] for k in order], axis=1)
        return [
            Channel(f"{self._topic.strip('/')}/{name}", row, unit or None, time)
            for name, unit, row in zip(self._names, self._units, values, strict=True)
        ]

    def _joined(self, begins: Array, lengths: list[int]) -> Array:
        """Begins of the blocks [s]: exactly the end of the one before, unless there is a gap."""
        ends = self._period * np.cumsum([0, *lengths[:-1]])
        late = np.diff(begins - ends, prepend=0.0)
        late[1:][np.abs(late[1:]) <= GAP * self._period] = 0.0
        return np.asarray(ends + np.cumsum(late))

    def _error(self, reason: str) -> RecordingError:
        return RecordingError(f"{self._topic}: a block: {one_line(reason, 200)}")
