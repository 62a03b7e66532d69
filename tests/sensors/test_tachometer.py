"""Times of pulses, against shafts whose angle is a closed form of the time."""

import math

import numpy as np
import pytest

from sensors.prescribed import read, scene_with, turning

RATE = 10_000.0
KEY = {"kind": "tachometer", "shaft": "carrier", "clock": 1e12}


def stamps(place, speed, duration=2.0, **own):
    """Times of pulses of a shaft with an angle and a speed over time, in turns."""
    scene = scene_with({**KEY, **own})
    time = np.arange(round(duration * RATE)) / RATE
    sensed = turning(scene, time, 0.0)
    sensed.angle[:, -1], sensed.speed[:, -1] = math.tau * place(time), math.tau * speed(time)
    (readings,) = read(scene, sensed)
    assert (readings.unit, readings.period) == ("s", 0.0)
    return readings.values


@pytest.mark.parametrize("pulses", [1, 7, 500])
def test_pulses_of_a_run_up_come_at_the_roots_of_its_angle(pulses):
    """15 t + 0.5 a t^2 turns: between samples by a cubic, to far less than a sample."""
    found = stamps(lambda t: 15.0 * t + 0.8 * t**2, lambda t: 15.0 + 1.6 * t, pulses=pulses)
    marks = np.arange(1, len(found) + 1) / pulses
    expected = (np.sqrt(15.0**2 + 3.2 * marks) - 15.0) / 1.6
    assert found == pytest.approx(expected, abs=2e-12)
    assert len(found) == math.floor(pulses * (15.0 * 1.9999 + 0.8 * 1.9999**2))


def test_a_shaft_that_vibrates_is_followed_between_samples():
    """2 t + 0.01 sin: the cubic through angles and speeds errs by (w T)^4/384."""
    omega = math.tau * 300.0
    found = stamps(
        lambda t: 2.0 * t + 1e-3 * np.sin(omega * t),
        lambda t: 2.0 + 1e-3 * omega * np.cos(omega * t),
    )
    shown = 2.0 * found + 1e-3 * np.sin(omega * found)
    bound = 1e-3 * (omega / RATE) ** 4 / 384.0
    assert np.abs(shown - np.arange(1, len(found) + 1)).max() < 2.0 * bound + 1e-11


@pytest.mark.parametrize("clock", [51_200.0, 5e6])
def test_the_counter_stamps_its_last_tick(clock):
    exact = stamps(lambda t: 15.0 * t, lambda t: 15.0 + 0.0 * t)
    found = stamps(lambda t: 15.0 * t, lambda t: 15.0 + 0.0 * t, clock=clock)
    ticks = found * clock
    assert ticks == pytest.approx(np.round(ticks), abs=1e-6)
    late = exact - found
    assert late.min() > -1e-11 and late.max() < 1.0 / clock


def test_a_mark_backwards_shows_its_other_edge():
    """Forwards at whole turns, backwards at those plus the width."""
    found = stamps(lambda t: 3.0 * t - 2.0 * t**2, lambda t: 3.0 - 4.0 * t, width=0.1, duration=1.6)
    forwards = (3.0 - math.sqrt(9.0 - 8.0)) / 4.0
    backwards = [(3.0 + math.sqrt(9.0 - 8.0 * place)) / 4.0 for place in (0.1, 1.1)]
    assert found == pytest.approx([forwards, backwards[1], backwards[0]], abs=1e-11)


def test_noise_is_that_of_an_edge():
    quiet = stamps(lambda t: 400.0 * t, lambda t: 400.0 + 0.0 * t)
    noisy = stamps(lambda t: 400.0 * t, lambda t: 400.0 + 0.0 * t, noise=1e-6)
    assert np.std(noisy - quiet) == pytest.approx(1e-6, rel=0.1)


def test_a_shaft_at_rest_has_no_pulses():
    assert len(stamps(lambda t: 0.4 + 0.0 * t, lambda t: 0.0 * t)) == 0
