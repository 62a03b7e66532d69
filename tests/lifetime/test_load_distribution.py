"""Distributions of loads against known signals."""

import math

import numpy as np
import pytest

from planetary_twin_py.lifetime.duty_table import Duty
from planetary_twin_py.lifetime.load_distribution import equivalent_torque, load_distribution

TURN = 2.0 * math.pi


def test_a_sawtooth_is_equally_long_at_every_torque():
    torque = np.linspace(-50.0, 150.0, 20_001)
    duty = Duty(
        np.full(20_001, 0.01), {"input_torque": torque, "input_speed": np.full(20_001, TURN)}
    )
    found = load_distribution(duty, 40)
    np.testing.assert_allclose(found.duration, 5.0, atol=0.021)
    np.testing.assert_allclose(found.turns, found.duration)
    assert found.duration.sum() == pytest.approx(duty.duration)
    assert (found.edges[0], found.edges[-1]) == (-50.0, 150.0)


def test_turns_count_in_both_directions_and_not_at_rest():
    columns = {
        "input_torque": np.array([10.0, 20.0, 30.0]),
        "input_speed": TURN * np.array([1.0, -2.0, 0.0]),
    }
    found = load_distribution(Duty(np.array([5.0, 4.0, 3.0]), columns), 3)
    np.testing.assert_allclose(found.duration, [5.0, 4.0, 3.0])
    np.testing.assert_allclose(found.turns, [5.0, 8.0, 0.0])


def test_scatter_within_a_row_is_normal():
    columns = {
        "input_torque": np.array([100.0]),
        "input_speed": np.array([TURN]),
        "input_torque_std": np.array([10.0]),
    }
    found = load_distribution(Duty(np.array([1000.0]), columns), 60)
    middle = 0.5 * (found.edges[1:] + found.edges[:-1])
    assert found.duration.sum() == pytest.approx(1000.0)
    assert (found.duration * middle).sum() / 1000.0 == pytest.approx(100.0)
    spread = math.sqrt((found.duration * (middle - 100.0) ** 2).sum() / 1000.0)
    assert spread == pytest.approx(10.0, rel=0.01)


def test_a_constant_torque_is_its_own_equivalent():
    assert equivalent_torque(np.array([80.0]), np.array([1e3]), 6.61, 1e3) == pytest.approx(80.0)
    assert equivalent_torque(np.array([80.0]), np.array([1e3]), 3.0, 8e3) == pytest.approx(40.0)


def test_the_equivalent_of_two_torques_does_their_damage():
    """Three speeds of a catalogue duty: 10, 6, 14 kN for 50, 30, 20 % of the time: 9.8206 kN."""
    turns = np.array([0.5 * 3000.0, 0.3 * 2000.0, 0.2 * 1000.0])
    found = equivalent_torque(np.array([10.0, -6.0, 14.0]), turns, 3.0, float(turns.sum()))
    assert found == pytest.approx(9.8206, abs=1e-4)
    assert equivalent_torque(np.zeros(2), np.ones(2), 3.0, 2.0) == 0.0
