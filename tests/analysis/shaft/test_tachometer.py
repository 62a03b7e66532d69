"""Angles from pulses, and from the vibration alone, of a run-up whose angle is known."""

import numpy as np
import pytest

import planetary_twin_py as pt

RATE = 25_600.0
TIME = np.arange(0.0, 2.0, 1.0 / RATE)
# From 900 to 1100 rpm in 2 s.
TURNS = 15.0 * TIME + 5.0 / 6.0 * TIME**2
PULSES = np.array([(-15.0 + np.sqrt(225.0 + 10.0 / 3.0 * n)) / (5.0 / 3.0) for n in range(34)])
ORDER = 100.0
VIBRATION = np.cos(ORDER * 2.0 * np.pi * TURNS)


def height(pulses):
    """Height of the line of order 100, and what was found about the pulses."""
    found = pt.tachometer_angle(pulses, TIME)
    spectrum = pt.order_spectrum(VIBRATION[found.inside], found.angle)
    (line,) = pt.strongest_lines(*spectrum, count=1)
    assert line.place == pytest.approx(ORDER, abs=0.01)
    return line.amplitude, found


def test_the_angle_between_pulses_is_that_of_an_even_acceleration():
    found = pt.tachometer_angle(PULSES, TIME)
    assert (found.missing, found.double) == ((), ())
    assert found.angle == pytest.approx(2.0 * np.pi * TURNS[found.inside], abs=1e-5)
    inside = TIME[found.inside]
    lines = 2.0 * np.pi * np.interp(inside, PULSES, np.arange(34.0))
    # Lines between the pulses err by a T^2/8 turns at most; the rms of a parabola is sqrt(8/15).
    largest = 2.0 * np.pi * 5.0 / 3.0 * np.diff(PULSES).max() ** 2 / 8.0
    error = np.sqrt(np.mean((lines - 2.0 * np.pi * TURNS[found.inside]) ** 2))
    assert 0.6 * largest < error < largest


def test_a_run_up_keeps_the_height_of_order_100():
    assert height(PULSES)[0] == pytest.approx(1.0, abs=1e-3)


def test_stamps_of_a_slow_clock_lower_the_line_by_less_than_0_3_per_cent():
    assert height(np.rint(51_200.0 * PULSES) / 51_200.0)[0] == pytest.approx(1.0, abs=3e-3)


@pytest.mark.parametrize("missing", [[7], [7, 8], [1], [12, 25]])
def test_missing_pulses_are_found_and_replaced(missing):
    line, found = height(np.delete(PULSES, missing))
    assert found.missing == pytest.approx(PULSES[missing], abs=2e-3)
    assert line == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize(("place", "later"), [(10, 0.004), (10, -0.004), (20, 0.02), (33, -0.01)])
def test_double_pulses_are_found_and_left_out(place, later):
    double = PULSES[place] + later
    line, found = height(np.sort([*PULSES, double]))
    assert found.double == pytest.approx([double])
    assert found.missing == ()
    assert line == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize(
    ("pulses", "message"),
    [
        (PULSES[:3], "3 values: must be at least 4"),
        (np.append(PULSES, np.inf), "time 34 is not finite"),
        (PULSES[::-1], "is not later than the one before"),
        (np.delete(PULSES, [3, 8, 13, 18, 23]), "5 missing and 0 double of 29: must be at most"),
        (np.delete(PULSES, 9) + 0.4 * 0.06 * (np.arange(33) > 8), "must be a whole number"),
        (PULSES + 9.0, "no sample between the pulses"),
    ],
)
def test_pulses_that_state_no_angle_are_refused(pulses, message):
    with pytest.raises(ValueError, match=message):
        pt.tachometer_angle(pulses, TIME)


def test_a_double_pulse_beside_a_missing_one_is_the_wrong_one():
    """Without the earlier of both, the step to the next pulse would be less than two."""
    double = PULSES[12] + 0.0015
    _, found = height(np.sort([*np.delete(PULSES, 13), double]))
    assert found.double == (double,)
    assert found.missing == pytest.approx([PULSES[13]], abs=2e-3)


def test_several_pulses_per_turn_count_as_parts_of_a_turn():
    found = pt.tachometer_angle(PULSES, TIME, pulses_per_turn=4)
    assert found.angle == pytest.approx(0.5 * np.pi * TURNS[found.inside], abs=1e-5)


def test_pulses_are_found_in_a_noisy_signal():
    signal = np.where(TURNS % 1.0 < 0.2, 4.0, 0.0)
    signal += 0.1 * np.random.default_rng(8).normal(size=len(signal))
    found = pt.pulse_times(signal, RATE)
    assert found == pytest.approx(PULSES[1 : 1 + len(found)], abs=1.0 / RATE)
    assert len(found) == 33
    with pytest.raises(ValueError, match="level = 9: must be between the extremes"):
        pt.pulse_times(signal, RATE, level=9.0)


def test_the_angle_follows_from_the_vibration_alone():
    """Mesh harmonic 1 of 30 teeth sweeps 450 to 550 Hz, below harmonic 2."""
    random = np.random.default_rng(9)
    angle = 2.0 * np.pi * TURNS
    signal = (
        np.cos(30.0 * angle) + 0.7 * np.cos(60.0 * angle) + 0.1 * random.normal(size=len(angle))
    )
    found = pt.angle_from_line(signal, RATE, (420.0, 580.0), 30.0)
    middle = slice(len(angle) // 50, -len(angle) // 50)
    error = (found - angle)[middle]
    assert (error - error.mean()).std() < 2e-3
    tracked = pt.order_spectrum(signal[middle], found[middle], window="flattop")
    near = np.abs(tracked.order - 60.0) < 1.0
    assert tracked.amplitude[near].max() == pytest.approx(0.7, rel=0.01)


def test_a_band_without_a_line_states_no_angle():
    noise = np.random.default_rng(10).normal(size=len(TIME))
    with pytest.raises(ValueError, match="the phase runs backwards"):
        pt.angle_from_line(noise, RATE, (100.0, 5000.0), 30.0)
    with pytest.raises(ValueError, match="order = 0: must be positive"):
        pt.angle_from_line(noise, RATE, (100.0, 5000.0), 0.0)
