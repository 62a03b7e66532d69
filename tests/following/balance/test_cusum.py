"""Steps in noise."""

import numpy as np
import pytest

from planetary_twin_py.following.balance.cusum import KAPPA, LIMIT, TERM, Cusum, limit

ONE, PERIOD = np.ones(1), 0.1  # [s]


def steps(values, cusum=None):
    cusum = cusum or Cusum()
    found = []
    for n, value in enumerate(values):
        steps = cusum.add(PERIOD * n, np.array([value]), ONE, ONE, PERIOD)
        found += [(since, PERIOD * n) for since in steps.since]
    return found, cusum


@pytest.mark.exhaustive
def test_no_alarm_in_a_day_of_noise():
    """An hour of each of 24 gearboxes."""
    cusum, ones = Cusum(24), np.ones(24)
    for n, row in enumerate(np.random.default_rng(1).standard_normal((36_000, 24))):
        assert not len(cusum.add(PERIOD * n, row, ones, ones, PERIOD).since)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_steps_are_found_when_the_sum_reaches_its_limit(sign):
    """The sum of terms of 1 s grows by the step in standard deviations less KAPPA."""
    count, step = 400, 0.8
    values = np.random.default_rng(1).standard_normal((1300, count))
    values[1000:] += sign * step
    cusum, ones, since, found = Cusum(count), np.ones(count), {}, {}
    for n, row in enumerate(values):
        steps = cusum.add(PERIOD * n, row, ones, ones, PERIOD)
        for gearbox, begin in zip(steps.gearbox, steps.since, strict=True):
            since.setdefault(gearbox, begin)
            found.setdefault(gearbox, PERIOD * n)
    assert len(found) == count
    delay = LIMIT / (step / np.sqrt(PERIOD / TERM) - KAPPA)
    assert np.mean(list(found.values())) == pytest.approx(100.0 + delay, abs=0.5 * TERM)
    off = np.abs(np.array(list(since.values())) - 100.0)
    assert np.median(off) < 0.5 and np.quantile(off, 0.75) < 4.0


def test_a_single_outlier_is_no_step():
    values = np.random.default_rng(3).standard_normal(2000)
    values[1000] = 1e6
    assert steps(values)[0] == []


def test_alarms_are_held_while_noise_correlates():
    noise = np.random.default_rng(4).standard_normal(20_000)
    slow = np.convolve(noise, np.ones(20), "valid") / np.sqrt(20.0)
    found, cusum = steps(slow)
    assert cusum.held and all(time < 60.0 for _, time in found)


def test_a_wave_has_the_correlation_of_its_closed_form():
    """Successive values of a wave of 100 values correlate by the cosine of their phase."""
    step = 2.0 * np.pi / 100.0
    _, cusum = steps(0.9 * np.sin(step * np.arange(4000)))
    assert cusum.correlation[0] == pytest.approx(np.cos(step), abs=0.01)


def test_white_innovations_reach_the_limit_as_rarely_as_stated():
    """With two sums, a limit for one false alarm in 200 terms."""
    terms, count, chance, found = 200, 1000, np.random.default_rng(7), 0
    assert limit(365.25 * 86_400.0, 60.0) == pytest.approx(np.log(365.25 * 1440.0) - 1.166)
    sums = Cusum(400, limit(60.0 * terms, 60.0), 60.0)
    for number in range(1, count + 1):
        steps = sums.add(60.0 * number, chance.standard_normal(400), *np.ones((2, 400)), 60.0)
        found += len(steps.gearbox)
    assert found == pytest.approx(400 * count / terms, rel=0.15)
