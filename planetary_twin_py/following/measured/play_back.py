"""Passes recorded readings to a follower, and returns the estimated state of every second."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..channels.sampled import Samples
from ..follower import Follower
from ..readings import Readings
from ..state import Following
from .messages import Block

EVERY = 1.0  # [s] between two estimated states


def play_back(
    follower: Follower,
    blocks: Sequence[Block],
    samples: Sequence[Samples] = (),
) -> Iterator[Following]:
    """Pass readings, in the order of arrival, to a follower; return its state after each second.

    The last state has the remarks on all of them.
    `samples` of other files are merged with the readings by time.
    """
    sources = [_Source(given, np.maximum.accumulate(given.stamps())) for given in samples]
    for source in sources:
        source.add_until(follower, -math.inf)  # nothing but what the samples are
    last_time = -math.inf
    for block in blocks:
        if not isinstance(block, Readings):
            follower.add(block)
            continue
        for rows, until in _seconds(block):
            follower.add(block.part(rows))
            for source in sources:
                source.add_until(follower, until)
            if follower.time > last_time + EVERY - 0.5 * follower.period:
                last_time = follower.time
                yield follower.estimate_alone()
    for source in sources:
        source.add_until(follower, math.inf)
    follower.finish()
    yield follower.estimate()


@dataclass
class _Source:
    """Samples of a file, of which those before `place` have been passed on."""

    samples: Samples
    time: NDArray[np.float64]  # latest stamp up to each sample [s], (n,)
    place: int = 0

    def add_until(self, follower: Follower, until: float) -> None:
        """Pass the samples on up to a time [s]."""
        end = self.place + int(np.searchsorted(self.time[self.place :], until))
        rows, self.place = slice(self.place, end), end
        follower.add(self.samples.part(rows))


def _seconds(part: Readings) -> Iterator[tuple[slice, float]]:
    """Rows of each second, and the time at which it ends."""
    time = np.maximum.accumulate(np.where(np.isfinite(part.time), part.time, -np.inf))
    begin = 0
    while begin < len(time):
        start = time[begin] if np.isfinite(time[begin]) else 0.0
        until = float(start + EVERY)
        end = max(int(np.searchsorted(time, until)), begin + 1)
        yield slice(begin, end), until
        begin = end
