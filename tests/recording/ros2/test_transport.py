"""The position of a playback follows its rate; only a seek makes it jump."""

import math

import pytest

from planetary_twin_py.recording.ros2.transport import AS_FAST_AS_IT_GOES, Transport

FAR = 10**18  # [ns] of a next message that is never reached


def running(rate_factor=1.0, position=0):
    transport = Transport(position, rate_factor)
    transport.resume(100.0)
    return transport


@pytest.mark.parametrize("rate_factor", [0.01, 1.0, 4.0])
def test_it_runs_at_its_rate(rate_factor):
    transport = running(rate_factor, 5_000)
    assert transport.position(102.0, FAR) == 5_000 + round(2e9 * rate_factor)
    assert transport.remaining(5_000 + 10**9, 100.0) == pytest.approx(1 / rate_factor)


def test_on_hold_the_position_is_constant_and_nothing_is_due():
    transport = running()
    transport.pause(101.0, FAR)
    assert transport.position(500.0, FAR) == 10**9
    assert transport.remaining(0, 500.0) == math.inf
    transport.pause(600.0, FAR)
    transport.resume(700.0)
    assert transport.position(700.5, FAR) == 1_500_000_000


def test_resuming_while_it_runs_changes_nothing():
    transport = running()
    transport.resume(101.0)
    assert transport.position(102.0, FAR) == 2 * 10**9


def test_another_rate_applies_from_the_present_position():
    transport = running()
    transport.set_rate(10.0, 101.0, FAR)
    assert transport.position(101.0, FAR) == 10**9
    assert transport.position(102.0, FAR) == 11 * 10**9


def test_a_late_message_has_not_been_reached():
    transport = running(100.0)
    late = 5 * 10**9  # due at 100.05
    transport.set_rate(1.0, 101.0, late)
    assert transport.position(101.5, FAR) == late + 500_000_000


def test_without_a_limit_everything_is_due_at_once():
    transport = running(AS_FAST_AS_IT_GOES)
    assert transport.remaining(FAR, 100.0) == 0.0
    transport.set_rate(1.0, 101.0, 7)
    assert transport.position(101.0, FAR) == 7


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
