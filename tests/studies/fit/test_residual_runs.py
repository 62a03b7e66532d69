"""Runs of one sign against the distribution of random orders, and against a slow misfit."""

import numpy as np
import pytest

from planetary_twin_py.studies.fit.residual_runs import count_runs


def test_random_orders_have_expected_runs_and_are_rarely_refused():
    chance = np.random.default_rng(1)
    found = [count_runs(chance.standard_normal(54)) for _ in range(2000)]
    assert np.mean([one.runs for one in found]) == pytest.approx(found[0].expected, rel=0.01)
    assert 0.002 < np.mean([not one.noise for one in found]) < 0.02


def test_a_slow_misfit_is_not_noise():
    misfit = np.sin(np.linspace(0.0, 6.0, 54))
    noise = 0.3 * np.random.default_rng(2).standard_normal(54)
    assert not count_runs(misfit + noise).noise


def test_few_residuals_say_nothing():
    assert count_runs(np.arange(8.0)) is None
    assert count_runs(np.zeros(20)) is None
