"""Steps in noise."""

import numpy as np
import pytest

from planetary_twin_py.following.cusum import Cusum


def steps(values, cusum=None):
    cusum = cusum or Cusum()
    found = [cusum.add(0.1 * n, value, 1.0) for n, value in enumerate(values)]
    return [step for step in found if step], cusum


@pytest.mark.exhaustive
def test_no_alarm_in_a_day_of_noise():
    found, _ = steps(np.random.default_rng(1).standard_normal(864_000))
    assert found == []


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_step_is_found_with_its_start(sign):
    values = np.random.default_rng(2).standard_normal(2000)
    values[1000:] += sign * 0.8
    (first, *_), _ = steps(values[:1200])
    assert first.since == pytest.approx(100.0, abs=2.0)
    assert 103.0 < first.found < 112.0


def test_a_single_outlier_is_no_step():
    values = np.random.default_rng(3).standard_normal(2000)
    values[1000] = 1e6
    assert steps(values)[0] == []


def test_alarms_are_held_while_noise_correlates():
    noise = np.random.default_rng(4).standard_normal(20_000)
    slow = np.convolve(noise, np.ones(20), "valid") / np.sqrt(20.0)
    found, cusum = steps(slow)
    assert cusum.held and all(step.found < 60.0 for step in found)


def test_a_wave_has_the_correlation_of_its_closed_form():
    """Successive values of a wave of 100 values correlate by the cosine of their phase."""
    step = 2.0 * np.pi / 100.0
    _, cusum = steps(0.9 * np.sin(step * np.arange(4000)))
    assert cusum.correlation == pytest.approx(np.cos(step), abs=0.01)
