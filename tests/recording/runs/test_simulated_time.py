"""Stamps have the simulated time of the states around them."""

import numpy as np
import pytest

from planetary_twin_py.recording.runs.simulated_time import SimulatedTime

SECOND = 1_000_000_000  # [ns]
BEGIN = 1_790_000_000 * SECOND
INTERVAL = 0.01  # [s]


def of_states(*parts):
    """States of parts of a run: simulated begin [s], ROS begin [s], number of intervals, pace."""
    stamp, time = [], []
    for begin, ros, count, pace in parts:
        passed = INTERVAL * np.arange(1, count + 1)
        time.append(begin + passed)
        stamp.append(BEGIN + np.rint(SECOND * (ros + pace * passed)).astype(np.int64))
    times = np.concatenate(time)
    return SimulatedTime(np.concatenate(stamp), times, np.full(len(times), INTERVAL))


def at(to_time, *seconds):
    return to_time(BEGIN + np.rint(SECOND * np.array(seconds)).astype(np.int64))


def test_stamps_in_a_run_and_beyond_its_ends_pass_with_time():
    to_time = of_states((0.0, 5.0, 100, 1.0))
    assert at(to_time, 5.0, 5.5, 6.0, 6.2, 4.9) == pytest.approx([0.0, 0.5, 1.0, 1.2, -0.1])


def test_a_pause_takes_no_simulated_time():
    to_time = of_states((0.0, 0.0, 100, 1.0), (1.0, 11.0, 100, 1.0))
    assert at(to_time, 0.995, 11.0, 11.005) == pytest.approx([0.995, 1.0, 1.005])
    assert at(to_time, 3.0, 10.9) == pytest.approx([1.0, 1.0])


def test_another_run_begins_at_its_own_zero():
    to_time = of_states((0.0, 0.0, 100, 1.0), (0.0, 2.5, 100, 1.0))
    assert at(to_time, 0.999, 2.501, 3.0) == pytest.approx([0.999, 0.001, 0.5])


def test_a_clock_that_is_faster_is_followed():
    to_time = of_states((0.0, 0.0, 100, 1.3))
    assert at(to_time, 0.13, 0.65, 1.295) == pytest.approx([0.1, 0.5, 1.295 / 1.3], abs=1e-6)
