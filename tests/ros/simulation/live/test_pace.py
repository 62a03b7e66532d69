"""Simulated time follows the steady clock; a delay is reported, never made up."""

import pytest
from planetary_twin.simulation.live import pace
from planetary_twin.simulation.live.pace import Pace

PERIOD = 0.01


class Clock:
    """A steady clock that advances by each sleep, plus `late` [s]."""

    def __init__(self, late: float = 0.0) -> None:
        self.now = 0
        self.late = late

    def monotonic_ns(self) -> int:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += round((seconds + self.late) * 1e9)


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    """A replacement for the machine's clock."""
    clock = Clock()
    monkeypatch.setattr(pace, "time", clock)
    return clock


def test_many_periods_add_up_without_drift(clock):
    clock.late = 0.3 * PERIOD
    pace = Pace(PERIOD, clock.sleep)
    pace.start()
    for _ in range(100):
        pace.wait()
    # The last wake-up is late; the delays of a hundred do not accumulate.
    assert clock.now * 1e-9 == pytest.approx(100.3 * PERIOD)
    assert pace.overruns == 0


def test_a_missed_deadline_is_counted_and_not_caught_up(clock):
    pace = Pace(PERIOD, clock.sleep)
    pace.start()
    clock.sleep(10 * PERIOD)
    pace.wait()
    assert pace.overruns == 1
    begin = clock.now
    pace.wait()
    assert (clock.now - begin) * 1e-9 == pytest.approx(PERIOD)
