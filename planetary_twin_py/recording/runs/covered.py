"""The simulated time of successive states, and those that are missing between them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from .schedule import stamp_of

_ROUNDING = 1e3  # [ns]; intervals are many times as long


class Covered(NamedTuple):
    """Simulated time of states [s], and the number of states missing between them."""

    time: float
    missing: int


def cover(states: Sequence[Any]) -> Covered:
    """Time of at least one state, and the states missing between them.

    States of one run without missing messages cover the time between the first and the last, so
    bisection finds the ends of runs and missing messages.
    """

    def after(first: int, last: int) -> Covered:
        """States after `first`, up to `last`, without the time of `first`."""
        if first == last:
            return Covered(0.0, 0)
        begin, end = states[first], states[last]
        if end.sequence - begin.sequence == last - first and _same_run(begin, end):
            return Covered(float(end.simulated_time - begin.simulated_time), 0)
        if last == first + 1:
            return Covered(float(end.interval), missing_between(begin, end))
        middle = (first + last) // 2
        first_half, second_half = after(first, middle), after(middle, last)
        return Covered(first_half.time + second_half.time, first_half.missing + second_half.missing)

    rest_covered = after(0, len(states) - 1)
    return rest_covered._replace(time=states[0].interval + rest_covered.time)


def missing_between(begin: Any, end: Any) -> int:
    """Number of states missing between two successive ones of a run; 0 if a run ends between."""
    return max(int(end.sequence - begin.sequence) - 1, 0) if _same_run(begin, end) else 0


def _same_run(begin: Any, end: Any) -> bool:
    """Whether ROS time and simulated time increased by the same amount."""
    simulated = end.simulated_time - begin.simulated_time
    return abs(stamp_of(end) - stamp_of(begin) - simulated * 1e9) < _ROUNDING
