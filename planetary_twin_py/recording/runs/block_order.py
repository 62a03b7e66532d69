"""The order of blocks of samples: which follow one another, are missing, or are recorded twice."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
ToTime = Callable[[NDArray[np.int64]], Array]
"""Seconds [s] of stamps [ns]."""
EARLY = 0.5  # of a block: a stamp that differs by less from the end of the block before adjoins it
PLACE = np.dtype(
    [
        ("sequence", "<i8"), ("stamp", "<i8"), ("period", "<f8"), ("count", "<i8"),
        ("source", "<i4"), ("place", "<i8"), ("number", "<i4"), ("row", "<i8"),
    ]
)  # fmt: skip
"""A block: its number, stamp [ns], sample period [s], samples of each channel, and where it is."""


class Segment(NamedTuple):
    """Blocks that follow one another without a gap."""

    begin: int
    """Number of the first block."""
    end: int
    """Number of the block after the last."""
    time: float
    """Of the first sample [s]."""
    period: float
    """Sample period [s]."""


class BlockOrder:
    """Blocks of one topic in the order of their stamps.

    Args:
        topic: name of the topic.
        every: all blocks, at least one, (n,) of `PLACE`.
    """

    def __init__(self, topic: str, every: NDArray[Any]) -> None:
        self._topic = topic
        self._every = every[np.lexsort((every["sequence"], every["stamp"]))]
        again = self._every[["stamp", "sequence"]]
        self._again = np.concatenate(([False], again[1:] == again[:-1]))

    @cached_property
    def blocks(self) -> NDArray[Any]:
        """Each block once."""
        return self._every[~self._again]

    @property
    def missing(self) -> int:
        """Number of blocks that are missing between the first and the last."""
        steps = np.diff(self.blocks["sequence"])
        return int((steps[steps > 1] - 1).sum())

    @property
    def doubled(self) -> int:
        """Number of blocks that are recorded again."""
        return int(np.count_nonzero(self._again))

    def segments(self, to_time: ToTime) -> list[Segment]:
        """Parts without a gap, in order.

        Args:
            to_time: gives the time axis.
        """
        cuts = [0, *(1 + np.flatnonzero(self._gaps(to_time))).tolist(), len(self.blocks)]
        time, period = to_time(self.blocks["stamp"]), self.blocks["period"]
        return [
            Segment(begin, end, float(time[begin]), float(period[begin]))
            for begin, end in pairwise(cuts)
        ]

    def remarks(self, to_time: ToTime) -> Iterator[str]:
        """A line each for missing blocks, doubled ones, and other gaps.

        Args:
            to_time: gives the time axis.
        """
        number, time = self.blocks["sequence"], to_time(self.blocks["stamp"])
        steps = np.diff(number)
        if len(lost := np.flatnonzero(steps > 1)):
            first = int(lost[0])
            end = time[first] + self._length[first]
            yield (
                f"{self._topic}: {counted(self.missing)} missing, the first after {end:.6g} s, "
                f"between numbers {number[first]} and {number[first + 1]}"
            )
        if self.doubled:
            first = int(np.argmax(self._again))
            yield (
                f"{self._topic}: {counted(self.doubled)} recorded twice, the first at "
                f"{to_time(self._every['stamp'][[first]])[0]:.6g} s, number "
                f"{self._every['sequence'][first]}; each is used once"
            )
        if len(others := np.flatnonzero(self._gaps(to_time) & (steps <= 1))):
            first = int(others[0])
            yield (
                f"{self._topic}: {counted(len(others))} not next to the one before, the first at "
                f"{time[first + 1]:.6g} s, {self._away(to_time)[first]:.3g} s after its end, "
                f"between numbers {number[first]} and {number[first + 1]}"
            )

    def _gaps(self, to_time: ToTime) -> NDArray[np.bool_]:
        """Whether there is a gap, or a change of the period, after each block but the last."""
        period = self.blocks["period"]
        follows = (np.diff(self.blocks["sequence"]) == 1) & (period[1:] == period[:-1])
        adjoins = np.abs(self._away(to_time)) <= EARLY * self._length[:-1]
        return np.asarray(~(follows & adjoins))

    def _away(self, to_time: ToTime) -> Array:
        """Time from the end of each block to the next [s]."""
        return np.diff(to_time(self.blocks["stamp"])) - self._length[:-1]

    @property
    def _length(self) -> Array:
        """Length of each block [s]."""
        return np.asarray(self.blocks["count"] * self.blocks["period"])


def counted(blocks: int) -> str:
    """A number of blocks, with the verb that follows."""
    return "1 block is" if blocks == 1 else f"{blocks} blocks are"


def since(first: int) -> ToTime:
    """Seconds since a stamp, for recordings without a twin.

    Args:
        first: the stamp of time 0 [ns].
    """
    return lambda stamp: np.asarray(1e-9 * (stamp - first))
