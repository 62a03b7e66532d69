"""The position of a playback follows its rate; only a seek makes it jump."""

import pytest

from planetary_twin_py.recording.ros2.transport import Transport

FAR = 10**18  # [ns] of a next message that is never reached


def running(rate_factor=1.0, position=0):
    transport = Transport(position, rate_factor)
    transport.resume(100.0)
    return transport


def test_resuming_while_it_runs_changes_nothing():
    transport = running()
    transport.resume(101.0)
    assert transport.position(102.0, FAR) == 2 * 10**9


def test_a_late_message_has_not_been_reached():
    transport = running(100.0)
    late = 5 * 10**9  # due at 100.05
    transport.set_rate(1.0, 101.0, late)
    assert transport.position(101.5, FAR) == late + 500_000_000


def test_a_seek_while_on_hold_keeps_the_hold():
    transport = Transport(0, 1.0)
    transport.place(50, 10.0)
    assert transport.position(99.0, FAR) == 50
    transport.resume(99.0)
    assert transport.position(99.0, FAR) == 50


def test_the_jump_of_a_loop_takes_no_time():
    transport = running(2.0)
    due = transport.remaining(10**9, 100.7)
    transport.shift(-(10**9))
    assert transport.remaining(0, 100.7) == pytest.approx(due)
