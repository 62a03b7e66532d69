"""The published intervals of a run, with little memory for each: a day may have 8.6 million."""

from __future__ import annotations

import math
from array import array
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import islice
from typing import NamedTuple, overload

from ...model.clock import TICKS


class Interval(NamedTuple):
    """A published interval, from its GearboxState."""

    number: int  # of its message
    stamp: int  # [ns]
    begin: int  # [ticks] of simulated time
    end: int
    tolerance: float
    sample_rate: float  # [Hz]
    recorded: bool = True  # False if its message is missing and was inferred


def in_ticks(number: int, time: float, length: float, before: Interval | None) -> tuple[int, int]:
    """Begin and end of an interval, in whole ticks although its times are rounded.

    A time of a day in double precision is rounded to 15 ticks. Successive intervals have the same
    length unless they differ by more, and leave no gap.

    Args:
        number: number of its message.
        time: end of the interval [s of simulated time].
        length: difference of its rounded end and begin [s].
        before: the interval before it in the recording; None for the first one.

    Returns:
        Begin and end [ticks].
    """
    blur = math.ceil(math.ulp(time) * TICKS)
    end, ticks = round(Fraction(time) * TICKS), round(Fraction(length) * TICKS)
    if before is not None and abs(ticks - (before.end - before.begin)) <= blur:
        ticks = before.end - before.begin
    elif blur > 1:  # a whole number of intervals per second, or a round length
        of_rate = round(TICKS / max(round(TICKS / ticks), 1))
        rounded = round(ticks, -math.ceil(math.log10(2 * blur)))
        ticks = next((n for n in (of_rate, rounded) if abs(n - ticks) <= blur), ticks)
    if before is not None:
        expected = before.end + (number - before.number) * ticks
        end = expected if abs(end - expected) <= blur else end
    return end - ticks, end


class Intervals(Sequence[Interval]):
    """Intervals in the order of time, 16 bytes for each that continues the one before.

    Args:
        intervals: the first ones.
    """

    def __init__(self, intervals: Iterable[Interval] = ()) -> None:
        self._stamps, self._ends = array("q"), array("q")
        self._starts: list[int] = []  # places of intervals that do not continue the one before
        self._firsts: list[Interval] = []  # the intervals there
        for interval in intervals:
            self.append(interval)

    def append(self, interval: Interval) -> None:
        """Add an interval at the end."""
        place = len(self)
        self._stamps.append(interval.stamp)
        self._ends.append(interval.end)
        if not place or self._continuing(place) != interval:
            self._starts.append(place)
            self._firsts.append(interval)

    @property
    def stamps(self) -> Sequence[int]:
        """ROS times of their ends [ns]."""
        return self._stamps

    def cut(self, place: int) -> Intervals:
        """Remove the intervals from `place` on, and return them."""
        if place == 0:  # without a copy
            rest = Intervals()
            self.__dict__, rest.__dict__ = rest.__dict__, self.__dict__
            return rest
        rest = Intervals(islice(self, place, None))
        del self._stamps[place:], self._ends[place:]
        kept = bisect_right(self._starts, place - 1)
        del self._starts[kept:], self._firsts[kept:]
        return rest

    def __len__(self) -> int:
        return len(self._stamps)

    @overload
    def __getitem__(self, place: int) -> Interval: ...
    @overload
    def __getitem__(self, place: slice) -> Sequence[Interval]: ...
    def __getitem__(self, place: int | slice) -> Interval | Sequence[Interval]:
        places = range(len(self))[place]
        return self._at(places) if isinstance(places, int) else [self._at(n) for n in places]

    def __iter__(self) -> Iterator[Interval]:
        return map(self._at, range(len(self)))

    def _at(self, place: int) -> Interval:
        stretch = bisect_right(self._starts, place) - 1
        if self._starts[stretch] == place:
            return self._firsts[stretch]
        return self._continuing(place)

    def _continuing(self, place: int) -> Interval:
        """The interval at `place`, if it continues the one before."""
        stretch = bisect_right(self._starts, place) - 1
        first = self._firsts[stretch]
        return first._replace(
            number=first.number + place - self._starts[stretch],
            stamp=self._stamps[place],
            begin=self._ends[place - 1],
            end=self._ends[place],
        )
