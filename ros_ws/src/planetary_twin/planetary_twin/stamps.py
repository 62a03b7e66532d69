"""ROS times of simulated instants: they only rise, whatever happens to the clocks."""

from __future__ import annotations

import time
from typing import NamedTuple

from rclpy.clock import Clock, ClockType, ROSClock

STEADY = Clock(clock_type=ClockType.STEADY_TIME)
"""For timers that must go on whatever /clock does."""
_SET = 100_000_000  # [ns] by which the system clock moves only where somebody sets it
_JUMP = 1_000_000_000  # [ns] by which a /clock does not move between two looks unless it jumps


class Rising:
    """A clock's time [ns]; where that stands or is turned back, just after the last."""

    def __init__(self, clock: ROSClock) -> None:
        self._clock = clock
        self._last = 0

    def now(self) -> int:
        """Return the time now [ns]."""
        self._last = max(self._clock.now().nanoseconds, self._last + 1)
        return self._last


class _Interval(NamedTuple):
    """Two simulated instants [s] and their ROS times [ns]."""

    begin: float
    end: float
    first: int
    last: int


class _Look(NamedTuple):
    """What the clocks say at one moment [ns]."""

    ros: int
    steady: int


class Stamps:
    """
    Maps simulated time to ROS time, interval after interval.

    Stamps run with simulated time from the ROS time at which they `begin`, and move with the
    system clock where that is set. With `use_sim_time` they are what /clock tells when an interval
    is published. Where a clock is turned back, they go on from the newest. A twin that is itself
    the `source` of /clock asks a clock but once. All are later than `newest` [ns].
    """

    def __init__(self, clock: ROSClock, source: bool, newest: int = 0) -> None:
        # A source of time must not wait for itself.
        self._clock = Clock(clock_type=ClockType.SYSTEM_TIME) if source else clock
        self._source = source
        self._interval = _Interval(0.0, 0.0, newest, newest)
        self._origin = 0  # ROS time of simulated time 0 [ns]
        self._before = _Look(0, 0)

    @property
    def newest(self) -> int:
        """Return the newest stamp [ns]."""
        return self._interval.last

    def ready(self) -> bool:
        """Whether there is a time: with `use_sim_time` there is none before the first /clock."""
        return not self._follows() or self._clock.now().nanoseconds > 0

    def begin(self, simulated: float) -> None:
        """Let `simulated` [s] be now, or just after the newest stamp if that is later."""
        newest = self._interval.last
        self._before = self._look()
        own = self._source and newest > 0
        self._place(simulated, simulated, newest + 1 if own else self._before.ros)

    def reach(self, simulated: float) -> None:
        """Let an interval that begins at the newest stamp end at `simulated` [s], now."""
        before, now = self._before, self._look()
        due = self._origin + round(simulated * 1e9)
        passed = now.ros - before.ros
        moved = passed - (now.steady - before.steady)
        if self._follows():
            self._before = now
            due = self._interval.last + passed if 0 <= passed < _JUMP else now.ros
        elif not self._source and abs(moved) > _SET:
            self._before = now
            due = min(due + moved, max(due, now.ros))  # no further ahead if they are already
        self._place(self._interval.end, simulated, due)

    def of(self, simulated: float) -> int:
        """ROS time [ns] of an instant [s] in the newest interval, or at its end."""
        begin, end, first, last = self._interval
        pace = (last - first) / (end - begin) if end > begin else 1e9
        return last + round((simulated - end) * pace)

    def _place(self, begin: float, end: float, stamp: int) -> None:
        first = self._interval.last
        last = max(stamp, first + 1)
        self._origin = last - round(end * 1e9)
        self._interval = _Interval(begin, end, first, last)

    def _follows(self) -> bool:
        return not self._source and self._clock.ros_time_is_active

    def _look(self) -> _Look:
        return _Look(self._clock.now().nanoseconds, time.monotonic_ns())
