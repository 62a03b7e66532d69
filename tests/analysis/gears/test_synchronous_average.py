"""The average over turns: what it keeps, and the comb with which it lowers the rest."""

import numpy as np
import pytest

import planetary_twin_py as pt

POINTS = 64


def averaged(tone, turns=20, speed=lambda time: 2.0 * np.pi * 10.0 * time, **how):
    """Average of a tone of an order, sampled at 20 kHz."""
    time = np.arange(0.0, turns / 10.0 + 0.01, 5e-5)
    angle = speed(time)
    return pt.time_synchronous_average(tone(angle), angle, POINTS, **how)


@pytest.mark.parametrize("order", [3, 7, 20])
def test_whole_orders_are_kept(order):
    found = averaged(lambda angle: 0.7 * np.cos(order * angle))
    assert found.turns.shape == (20, POINTS)
    assert found.average == pytest.approx(0.7 * np.cos(order * found.angle), abs=2e-3)
    assert found.noise < 1e-3


@pytest.mark.parametrize("order", [1.05, 1.5, 7.0 / 3.0, 5.02])
def test_other_orders_are_lowered_by_the_comb(order):
    """|sin(pi M f)/(M sin(pi f))|: 0 at 1.05 and 1.5 with M = 20, and 0.05 at 7/3."""
    comb = abs(np.sin(np.pi * 20 * order) / (20 * np.sin(np.pi * order)))
    cosine, sine = (averaged(lambda angle, f=f: f(order * angle)).average for f in (np.cos, np.sin))
    height = np.abs(cosine + 1j * sine)
    assert height == pytest.approx(np.full(POINTS, comb), abs=4e-3)


def test_noise_is_lowered_to_its_share_and_stated():
    samples = np.random.default_rng(5).normal(size=400 * POINTS)
    angle = 2.0 * np.pi / POINTS * np.arange(len(samples))
    found = pt.time_synchronous_average(samples, angle, POINTS)
    turns = len(found.turns)
    assert found.average.std() == pytest.approx(1.0 / np.sqrt(turns), rel=0.15)
    assert found.noise == pytest.approx(1.0 / np.sqrt(turns), rel=0.02)


def test_a_gear_may_turn_faster_than_the_shaft_whose_angle_is_known():
    """A planet with 20 teeth turns 30/20 per turn of the sun, relative to the carrier."""
    found = averaged(lambda angle: np.cos(1.5 * 4.0 * angle), turns_per_revolution=1.5)
    assert len(found.turns) == 30
    assert found.average == pytest.approx(np.cos(4.0 * found.angle), abs=2e-3)


def test_a_run_up_is_averaged_as_a_constant_speed():
    found = averaged(
        lambda angle: np.cos(5.0 * angle), speed=lambda t: 2.0 * np.pi * (8.0 * t + 2.0 * t**2)
    )
    assert found.average == pytest.approx(np.cos(5.0 * found.angle), abs=2e-3)


def test_short_records_and_several_channels_are_refused():
    angle = np.linspace(0.0, 1.9 * 2.0 * np.pi, 1000)
    with pytest.raises(ValueError, match=r"1\.9 turns of the gear: must be at least 2"):
        pt.time_synchronous_average(np.ones(1000), angle)
    with pytest.raises(ValueError, match="must be one channel"):
        pt.time_synchronous_average(np.ones((1000, 2)), angle)
    with pytest.raises(ValueError, match="turns_per_revolution = 0: must be positive"):
        pt.time_synchronous_average(np.ones(1000), angle, turns_per_revolution=0.0)
