"""Simulated time follows the steady clock, and falling behind is told, never made up."""

import time

from planetary_twin.pacing import Pace

PERIOD = 0.01


def test_many_periods_add_up_without_drift() -> None:
    pace = Pace(PERIOD)
    begin = time.monotonic()
    pace.start()
    for _ in range(100):
        pace.wait()
    # Lateness of one wake-up is allowed; a hundred of them adding up is not.
    assert 1.0 <= time.monotonic() - begin < 1.0 + 2 * PERIOD + pace.overruns * 10 * PERIOD


def test_waiting_costs_no_processor_time() -> None:
    pace = Pace(PERIOD)
    before = time.thread_time()
    pace.start()
    for _ in range(50):
        pace.wait()
    assert time.thread_time() - before < 0.1 * 50 * PERIOD


def test_a_missed_deadline_is_counted_and_not_caught_up_in_a_burst() -> None:
    pace = Pace(PERIOD)
    pace.start()
    time.sleep(10 * PERIOD)
    pace.wait()
    assert pace.overruns == 1
    begin = time.monotonic()
    pace.wait()
    assert time.monotonic() - begin > 0.5 * PERIOD
