"""Estimates and intervals from residuals of a known model: a decaying exponential."""

import numpy as np
import pytest

from planetary_twin_py.studies.fit.estimate import conclude
from planetary_twin_py.studies.fit.least_squares import search, with_initial_magnitudes
from planetary_twin_py.studies.fit.parameter import Parameter

TIME = np.linspace(0.0, 3.0, 25)
TRUTH = np.array([2.0, 0.7])
NOISE = 0.05
FREE = (Parameter("height", "m", 0.0, 100.0, 5.0), Parameter("rate", "1/s", 0.0, 50.0, 0.2))


def decay(values):
    return values[0] * np.exp(-values[1] * TIME)


def residuals_of(model, data, noise=NOISE):
    return lambda points: [(model(point) - data) / noise for point in points]


def estimate(model, data, free=FREE, freedom=np.inf, confidence=0.95):
    residuals = residuals_of(model, data)
    return conclude(residuals, free, search(residuals, free), freedom, confidence)


def noise_of(seed):
    return NOISE * np.random.default_rng(seed).standard_normal(len(TIME))


def test_intervals_contain_the_truth_as_often_as_they_state():
    runs = 300
    found = [estimate(decay, decay(TRUTH) + noise_of(seed)) for seed in range(runs)]
    values = np.array([e.values for e in found])
    error = values.mean(axis=0) - TRUTH
    assert np.all(np.abs(error) < 3.0 * values.std(axis=0) / np.sqrt(runs))
    for k, truth in enumerate(TRUTH):
        held = sum(e.intervals[k].low <= truth <= e.intervals[k].high for e in found)
        assert abs(held / runs - 0.95) < 3.0 * np.sqrt(0.95 * 0.05 / runs)


def test_noise_known_to_few_degrees_of_freedom_widens_intervals():
    data = decay(TRUTH) + noise_of(1)
    wide, narrow = (estimate(decay, data, freedom=f).intervals[0] for f in (4, np.inf))
    assert wide.high - wide.low == pytest.approx(
        (narrow.high - narrow.low) * 2.776 / 1.960, rel=1e-3
    )


def test_a_parameter_without_effect_affects_no_other():
    found = estimate(lambda v: decay([v[0], TRUTH[1]]), decay(TRUTH) + noise_of(2))
    assert found.not_identifiable == ((1,),)
    assert found.identifiable(0) and not found.identifiable(1)
    assert found.intervals[1][:2] == (0.0, 50.0)
    alone = estimate(lambda v: decay([v[0], TRUTH[1]]), decay(TRUTH) + noise_of(2), free=FREE[:1])
    assert found.intervals[0] == pytest.approx(alone.intervals[0], rel=1e-4)


def test_parameters_with_the_same_effect_are_named_together():
    found = estimate(lambda v: decay([v[0] * v[1], TRUTH[1]]), decay(TRUTH) + noise_of(3))
    assert found.not_identifiable == ((0, 1),)


def test_at_its_bound_interval_ends_there_and_follows_profile():
    truth = np.array([2.0, 0.0])
    held, at_bound = 0, 0
    for seed in range(40):
        found = estimate(decay, decay(truth) + noise_of(seed))
        low, high, profiled = found.intervals[1]
        held += low <= 0.0 <= high
        at_bound += found.at_bound[1]
        assert low >= 0.0 and (profiled or low > 0.0)
    assert held >= 34
    assert 10 <= at_bound <= 30  # half of the noise points beyond it


def test_a_second_minimum_does_not_trap_the_search():
    def waves(values):
        return np.sin(2.0 * np.pi * values[0] * TIME)

    free = (Parameter("frequency", "Hz", 0.0, 10.0, 1.9),)
    found = estimate(waves, waves([0.5]), free=free)
    assert found.values == pytest.approx([0.5], rel=1e-4)


def test_a_model_that_does_not_fit_widens_the_intervals():
    data = decay(TRUTH) + 0.3 * np.sin(4.0 * TIME)
    found = estimate(decay, data)
    assert found.excess > 10.0
    sound = estimate(decay, decay(TRUTH) + noise_of(4))
    width, usual = (e.intervals[0].high - e.intervals[0].low for e in (found, sound))
    assert width > 2.0 * usual


@pytest.mark.parametrize("truth", [3e-4, 40.0])
def test_a_search_that_starts_at_zero_finds_the_magnitude(truth):
    free = (Parameter("height", "m", 0.0, 1e6, 0.0),)
    data = decay([truth, 0.7])
    residuals = residuals_of(lambda v: decay([v[0], 0.7]), data, 1e-3 * truth)
    found = conclude(
        residuals, free, search(residuals, with_initial_magnitudes(residuals, free)), 99, 0.95
    )
    assert found.values == pytest.approx([truth], rel=1e-5)


def test_an_estimate_at_the_end_of_its_range_is_the_free_one():
    short = (Parameter("height", "m", 0.0, 1.5, 1.0),)
    found = estimate(lambda v: decay([v[0], TRUTH[1]]), decay(TRUTH), short)
    assert found.at_bound == (True,)
    assert found.values == pytest.approx([1.5], rel=1e-3)
    assert found.unbounded == pytest.approx([TRUTH[0]], rel=1e-6)
