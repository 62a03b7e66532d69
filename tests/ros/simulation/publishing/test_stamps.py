"""Stamps follow a system clock that is set forward, and always increase."""

from collections import deque
from types import SimpleNamespace

import pytest
from planetary_twin.simulation.publishing import stamps as stamps_file
from planetary_twin.simulation.publishing.stamps import Stamps
from rclpy.clock import ROSClock
from rclpy.duration import Duration
from rclpy.time import Time

HOUR = 3600.0  # [s]
INTERVAL = 0.01  # [s]


class Settable:
    """The system clock after somebody has set it by `ahead` [s]."""

    ros_time_is_active = False

    def __init__(self) -> None:
        self._clock = ROSClock()
        self.ahead = 0.0

    def now(self) -> Time:
        return self._clock.now() + Duration(seconds=self.ahead)


class Course:
    """Stamps [s after the first] of successive intervals."""

    def __init__(self, *, source: bool = False) -> None:
        self.clock = Settable()
        self._stamps = Stamps(self.clock, source)
        self._stamps.begin(0.0)
        self._first = self._stamps.of(0.0)
        self._count = 0
        self.stamps = [0.0]

    def go(self, intervals: int = 3) -> float:
        """Time [s] by which the stamps advance."""
        before = self.stamps[-1]
        for _ in range(intervals):
            self._count += 1
            self._stamps.reach(self._count * INTERVAL)
            stamp = self._stamps.of(self._count * INTERVAL)
            assert self._first + round(self.stamps[-1] * 1e9) < stamp
            self.stamps.append((stamp - self._first) * 1e-9)
        return self.stamps[-1] - before


def test_they_follow_a_clock_set_forward_not_one_set_back():
    course = Course()
    course.clock.ahead = HOUR
    assert course.go() == pytest.approx(HOUR, abs=1.0)
    course.clock.ahead = -HOUR
    assert course.go(100) == pytest.approx(99 * INTERVAL, abs=1e-6)
    course.clock.ahead = HOUR
    assert course.go(100) == pytest.approx(100 * INTERVAL, abs=1e-6)
    course.clock.ahead = 2 * HOUR
    assert course.go() == pytest.approx(HOUR, abs=2.0)


def test_a_source_of_time_reads_no_other_clock():
    course = Course(source=True)
    course.clock.ahead = HOUR
    assert course.go() == pytest.approx(3 * INTERVAL, abs=1e-6)


class Late:
    """A clock and the steady clock of a twin that computes intervals of 10 ms."""

    ros_time_is_active = False

    def __init__(self, monkeypatch: pytest.MonkeyPatch, max_lag: float) -> None:
        self._time = 1_000_000_000  # [ns]
        clock = SimpleNamespace(monotonic_ns=lambda: self._time)
        monkeypatch.setattr(stamps_file, "time", clock)
        self.stamps = Stamps(self, False, max_lag=max_lag)
        self.stamps.begin(0.0)
        self._count = 0

    def now(self) -> Time:
        return Time(nanoseconds=self._time)

    def go(self, lasts: float = INTERVAL) -> bool:
        """An interval that lasts so long [s]; whether it skips a lag."""
        self._time += round(lasts * 1e9)
        self._count += 1
        return self.stamps.reach(self._count * INTERVAL)

    def behind(self) -> float:
        """ROS time less the newest stamp [s]."""
        return (self._time - self.stamps.newest) * 1e-9


def test_without_a_limit_the_lag_of_a_stall_remains_and_is_known(monkeypatch):
    late = Late(monkeypatch, 0.0)
    assert not any(late.go(lasts) for lasts in (INTERVAL, 8.75 + INTERVAL, INTERVAL))
    assert late.stamps.lag == pytest.approx(late.behind()) == pytest.approx(8.75)
    late.stamps.begin(0.03)  # after a pause
    assert late.stamps.lag == late.behind() == 0.0


@pytest.mark.parametrize("stall", [0.3, 8.75])
def test_a_larger_lag_is_skipped_once_and_stamps_still_increase(monkeypatch, stall):
    late = Late(monkeypatch, 0.2)
    late.go()
    before = late.stamps.newest
    assert late.go(stall + INTERVAL)
    assert late.stamps.skips == deque([(INTERVAL, pytest.approx(stall))])
    assert late.stamps.lag == late.behind() == 0.0
    assert before <= late.stamps.of(INTERVAL) < late.stamps.of(1.5 * INTERVAL)
    assert not late.go()
    assert len(late.stamps.skips) == 1


def test_a_slow_twin_lags_by_no_more_than_its_limit(monkeypatch):
    """At a real-time factor of 0.948, for 400 s."""
    late = Late(monkeypatch, 0.2)
    lags = []
    for _ in range(40_000):
        late.go(INTERVAL / 0.948)
        lags.append(late.behind())
    assert max(lags) <= 0.2
    skipped = sum(skip.lag for skip in late.stamps.skips)
    assert skipped + lags[-1] == pytest.approx(400.0 * (1.0 / 0.948 - 1.0))


def test_an_instant_before_a_pause_has_the_time_before_it():
    clock = Settable()
    stamps = Stamps(clock, source=False)
    stamps.begin(0.0)
    for number in range(1, 4):
        stamps.reach(number * INTERVAL)
    before = [stamps.of(at) for at in (0.005, 0.025)]
    clock.ahead = HOUR
    stamps.begin(0.03)
    stamps.reach(0.04)
    assert [stamps.of(at) for at in (0.005, 0.025)] == before
    assert stamps.of(0.035) > before[1] + 3599 * 10**9
