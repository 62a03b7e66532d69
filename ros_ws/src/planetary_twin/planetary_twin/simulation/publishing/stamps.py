"""ROS times of simulated instants, which increase strictly, even if a clock is set back."""

from __future__ import annotations

import time
from collections import deque
from typing import NamedTuple

from rclpy.clock import Clock
from rclpy.clock_type import ClockType

from ...base.clock import has_time, is_simulated

_SET = 100_000_000  # [ns] a larger step of the system clock means that it was set
_JUMP = 1_000_000_000  # [ns] a larger step of /clock between two readings is a jump
_GAP = 1_000_000_000  # [ns] more time between two stamps is not spread over the interval
_KEPT = 1000  # intervals, from which sensors are late by their filters


class _Interval(NamedTuple):
    """Two simulated instants [s] and their ROS times [ns]."""

    begin: float
    end: float
    first: int
    last: int


class Skip(NamedTuple):
    """A jump of the stamps against simulated time."""

    time: float
    """Simulated time [s] from which stamps are later."""
    lag: float
    """Time [s] by which they are later: the lag before."""


class _Reading(NamedTuple):
    """Simultaneous readings of two clocks [ns]."""

    ros: int
    steady: int


class Stamps:
    """
    Maps simulated time to ROS time, interval after interval.

    Stamps run with simulated time from the ROS time at which `begin` is called, and follow the
    system clock if it is set. With `use_sim_time`, they are the time of `clock` when an interval
    is published. If a clock is set back, they continue from the newest stamp. A twin that is
    itself the `source` of /clock reads a clock only once. All stamps are later than `newest` [ns].

    A twin that has stalled, or computes too slowly, is late: stamps that run with simulated time
    lag behind ROS time. If the lag exceeds `max_lag` [s] and that is not 0, they skip it.
    """

    def __init__(self, clock: Clock, source: bool, newest: int = 0, max_lag: float = 0.0) -> None:
        # A source of /clock must not wait for its own messages.
        self._clock = Clock(clock_type=ClockType.SYSTEM_TIME) if source else clock
        self._source = source
        self._interval = _Interval(0.0, 0.0, newest, newest)
        self._past = deque[_Interval](maxlen=_KEPT)
        self._origin = 0  # ROS time of simulated time 0 [ns]
        self._before = _Reading(0, 0)
        self._max_lag = max_lag
        self.lag = 0.0
        """ROS time at the end of the newest interval, less its stamp [s]."""
        self.skips = deque[Skip]()
        """Skips that have not been reported; who reports one removes it."""

    @property
    def newest(self) -> int:
        """Newest stamp [ns]."""
        return self._interval.last

    def ready(self) -> bool:
        """Return whether ROS time is available: with `use_sim_time`, after the first /clock."""
        return self._source or has_time(self._clock)

    def begin(self, simulated: float) -> None:
        """Map `simulated` [s] to the present time, or just after the newest stamp if later."""
        newest = self._interval.last
        if simulated < self._interval.end:  # another run
            self._past.clear()
        self._before = self._read()
        own = self._source and newest > 0
        self._place(simulated, simulated, newest + 1 if own else self._before.ros)
        self.lag = 0.0

    def reach(self, simulated: float) -> bool:
        """
        Add an interval that starts at the newest stamp and ends at `simulated` [s], now.

        Returns whether its stamps have skipped a lag.
        """
        before, now = self._before, self._read()
        due = self._origin + round(simulated * 1e9)
        passed = now.ros - before.ros
        moved = passed - (now.steady - before.steady)
        if self._follows():
            self._before = now
            due = self._interval.last + passed if 0 <= passed < _JUMP else now.ros
        elif not self._source and abs(moved) > _SET:
            self._before = now
            due = min(due + moved, max(due, now.ros))  # stamps that are ahead are not increased
        lag = 0.0 if self._source or self._follows() else 1e-9 * (now.ros - due)
        skipped = 0.0 < self._max_lag < lag
        if skipped:
            self.skips.append(Skip(self._interval.end, lag))
            due, lag = now.ros, 0.0
        self._place(self._interval.end, simulated, due)
        self.lag = lag
        return skipped

    def of(self, simulated: float) -> int:
        """
        Return the ROS time [ns] of the instant `simulated` [s].

        It may be in an interval before the newest, which a pause or a skip may separate from it.
        """
        begin, end, first, last = self._interval
        if simulated < begin:
            earlier = (each for each in reversed(self._past) if each.begin <= simulated)
            begin, end, first, last = next(earlier, self._interval)
        pace = (last - first) / (end - begin) if end > begin else 1e9
        return last + round((simulated - end) * pace)

    def _place(self, begin: float, end: float, stamp: int) -> None:
        first = self._interval.last
        last = max(stamp, first + 1)
        self._origin = last - round(end * 1e9)
        length = round((end - begin) * 1e9)
        if last - first > length + _GAP:
            first = last - length
        self._interval = _Interval(begin, end, first, last)
        if end > begin:
            self._past.append(self._interval)

    def _follows(self) -> bool:
        return not self._source and is_simulated(self._clock)

    def _read(self) -> _Reading:
        return _Reading(self._clock.now().nanoseconds, time.monotonic_ns())
