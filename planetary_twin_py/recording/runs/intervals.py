"""The published intervals of a run, with little memory for each: a day may have 8.6 million."""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple, overload


class Interval(NamedTuple):
    """A published interval, from its GearboxState."""

    number: int  # of its message
    stamp: int  # [ns]
    begin: int  # [ticks] of simulated time
    end: int
    tolerance: float
    sample_rate: float  # [Hz]
    recorded: bool = True  # False if its message is missing and was inferred


_TYPES = "qqqqddb"  # of the fields, as of `array`


class Intervals(Sequence[Interval]):
    """Intervals in the order of time, in a column for each field.

    Args:
        intervals: the first ones.
    """

    def __init__(self, intervals: Iterable[Interval] = ()) -> None:
        self._columns: tuple[array[Any], ...] = tuple(array(kind) for kind in _TYPES)
        for interval in intervals:
            self.append(interval)

    def append(self, interval: Interval) -> None:
        """Add an interval at the end."""
        for column, value in zip(self._columns, interval, strict=True):
            column.append(value)

    @property
    def stamps(self) -> Sequence[int]:
        """ROS times of their ends [ns]."""
        return self._columns[1]

    def cut(self, place: int) -> Intervals:
        """Remove the intervals from `place` on, and return them."""
        rest = Intervals()
        if place == 0:  # without a copy
            self._columns, rest._columns = rest._columns, self._columns
            return rest
        rest._columns = tuple(column[place:] for column in self._columns)
        for column in self._columns:
            del column[place:]
        return rest

    def __len__(self) -> int:
        return len(self._columns[0])

    @overload
    def __getitem__(self, place: int) -> Interval: ...
    @overload
    def __getitem__(self, place: slice) -> Sequence[Interval]: ...
    def __getitem__(self, place: int | slice) -> Interval | Sequence[Interval]:
        if isinstance(place, slice):
            return [self[number] for number in range(*place.indices(len(self)))]
        return _interval(column[place] for column in self._columns)

    def __iter__(self) -> Iterator[Interval]:
        return map(_interval, zip(*self._columns, strict=True))


def _interval(values: Iterable[Any]) -> Interval:
    number, stamp, begin, end, tolerance, sample_rate, recorded = values
    return Interval(number, stamp, begin, end, tolerance, sample_rate, bool(recorded))
