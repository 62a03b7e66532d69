"""Clocks and stamps of ROS."""

from __future__ import annotations

from builtin_interfaces.msg import Time
from rclpy.clock import Clock, ROSClock
from rclpy.clock_type import ClockType

STEADY = Clock(clock_type=ClockType.STEADY_TIME)
"""For timers that must not depend on /clock."""
CLOCK_AWAITED = "use_sim_time: waits for the first message on /clock"


def is_simulated(clock: Clock) -> bool:
    """Return whether `clock` follows /clock, as with `use_sim_time`."""
    return isinstance(clock, ROSClock) and clock.ros_time_is_active


def has_time(clock: Clock) -> bool:
    """Return whether `clock` has a time: with `use_sim_time`, after the first /clock."""
    return not is_simulated(clock) or clock.now().nanoseconds > 0


def set_stamp(message: Time, stamp: int) -> None:
    """Write a time [ns since the epoch] into `message`."""
    message.sec, message.nanosec = divmod(stamp, 1_000_000_000)


class StrictClock:
    """The time of `clock` [ns], made to increase strictly if the clock stops or is set back."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._last = 0

    def now(self) -> int:
        """Return the present time [ns], at least 1 ns after the last one."""
        self._last = max(self._clock.now().nanoseconds, self._last + 1)
        return self._last
