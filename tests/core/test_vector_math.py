"""Functions and products for vector registers against the C library and numpy."""

import math

import numpy as np
import pytest
from planetary_twin_core_parts import exp, log, power, precise_exp, sin_cos


def test_exp_is_accurate_over_the_whole_double_range():
    x = np.concatenate([np.linspace(-699.0, 699.0, 20001), np.linspace(-1.0, 1.0, 2001)])
    mine = np.array([exp(value) for value in x])
    assert np.abs(mine / np.exp(x) - 1.0).max() < 1e-11


def test_exp_saturates_beyond_the_double_range():
    assert exp(1e6) == exp(700.0) == pytest.approx(math.exp(700.0), rel=1e-11)
    assert exp(-math.inf) == pytest.approx(math.exp(-700.0), rel=1e-11)


def test_log_is_accurate_for_all_normal_numbers():
    x = np.concatenate([np.logspace(-307, 308, 20001), np.linspace(0.4, 2.5, 20001)])
    mine = np.array([log(value) for value in x])
    assert np.abs(mine - np.log(x)).max() < 1e-12


def test_precise_exp_keeps_its_last_digits():
    x = np.concatenate([np.linspace(-699.0, 0.0, 20001), -np.logspace(-20, 0, 2001)])
    mine = np.array([precise_exp(value) for value in x])
    assert np.abs(mine / np.exp(x) - 1.0).max() < 1e-15
    assert precise_exp(0.0) == 1.0
    assert precise_exp(-1e6) == pytest.approx(math.exp(-700.0), rel=1e-15)


def test_sine_and_cosine_keep_their_last_digits():
    x = np.concatenate([
        np.linspace(0.0, 1e5, 50001), np.linspace(0.0, 10.0, 10001), np.logspace(-20, 5, 5001),
        np.arange(2000) * (np.pi / 4),
    ])  # fmt: skip
    x = np.concatenate([x, -x])
    mine = np.array([sin_cos(value) for value in x])
    assert np.abs(mine - np.column_stack([np.sin(x), np.cos(x)])).max() < 5e-16
    small = np.logspace(-300, -9, 1001)
    assert [sin_cos(value)[0] for value in small] == pytest.approx(small, rel=1e-15)


@pytest.mark.parametrize("exponent", [-1.0 / 3.0, 0.1, 2.0 / 3.0, 0.8, 1.6])
def test_power_is_accurate_and_vanishes_with_its_base(exponent):
    x = np.logspace(-100, 100, 20001)
    mine = np.array([power(value, exponent) for value in x])
    assert np.abs(mine / x**exponent - 1.0).max() < 1e-11
    assert exponent < 0.0 or power(0.0, exponent) < 1e-30
