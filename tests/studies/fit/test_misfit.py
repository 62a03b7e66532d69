"""The noise of means, compared with the scatter of many of them."""

import numpy as np
import pytest

from planetary_twin_py.studies.fit.misfit import measure_noise
from planetary_twin_py.studies.fit.readings import Readings

ROWS, RUNS = 400, 300


def runs_of(correlation):
    """Runs of a first-order autoregressive process of unit variance, (RUNS, ROWS)."""
    rng = np.random.default_rng(5)
    noise = rng.standard_normal((RUNS, ROWS))
    for k in range(1, ROWS):
        noise[:, k] = correlation * noise[:, k - 1] + np.sqrt(1 - correlation**2) * noise[:, k]
    return noise


def noise_of(values):
    readings = Readings("power_loss", values[:, None], np.zeros(1, int), np.zeros(ROWS, int))
    still = Readings("power_loss", np.zeros((ROWS, 1)), readings.kinds, readings.segment)
    return measure_noise([readings], [still], 1e-9, {}).noise[0]


@pytest.mark.parametrize("correlation", [0.0, 0.5, 0.9])
def test_the_noise_of_a_mean_is_the_scatter_of_many_means(correlation):
    runs = runs_of(correlation)
    found = np.sqrt(np.mean([noise_of(run).mean[0, 0] ** 2 for run in runs]))
    assert found == pytest.approx(runs.mean(axis=1).std(), rel=0.15)


def test_only_correlated_readings_are_reported_as_correlated():
    assert sum(noise_of(run).correlation > 0.0 for run in runs_of(0.0)) <= 3
    assert all(0.3 < noise_of(run).correlation < 0.7 for run in runs_of(0.5))
