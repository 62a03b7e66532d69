"""exp and log for vector registers against the C library's."""

import math

import numpy as np
import pytest

from planetary_twin_py._vector_math import exp, log


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
