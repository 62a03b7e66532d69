"""Order, gaps and outliers of readings."""

import numpy as np
import pytest

from planetary_twin_py.following.arrival.bins import Bins


def means(time, value, cuts=(), bins=None, channel="input_torque"):
    """Bins of one channel, as (number, mean, readings), and what collected them."""
    bins = bins or Bins(0.1, {channel: 0.1})
    found = []
    for rows in np.split(np.arange(len(time)), cuts):
        found += bins.add(time[rows], {channel: value[rows]})
    found += bins.finish()
    return [(b.number, *b.means[channel][:2]) for b in found], bins.counters


TIME = np.arange(300) / 100.0 + 0.005
VALUE = np.random.default_rng(0).normal(5.0, 0.1, 300)


def test_a_bin_is_the_mean_of_its_readings():
    found, counters = means(TIME, VALUE)
    assert [number for number, _, _ in found] == list(range(30))
    expected = VALUE.reshape(30, 10).mean(axis=1)
    assert [mean for _, mean, _ in found] == pytest.approx(list(expected), abs=1e-12)
    assert counters.used == 300


@pytest.mark.parametrize("first", [1, 6, 7])  # of the readings of the first bin
def test_error_of_incomplete_bin_is_that_of_mean_of_its_readings(first):
    """Without a trend; a line would be wrong by several times the noise at the middle."""
    errors = []
    for seed in range(400):
        value = np.random.default_rng(seed).normal(5.0, 0.1, 10)
        (_, mean, readings), *_ = means(TIME[first:10], value[first:])[0]
        errors.append((mean - 5.0) / (0.1 / np.sqrt(readings)))
    assert np.std(errors) < 1.3


@pytest.mark.parametrize("seed", range(5))
def test_the_order_within_the_lag_does_not_change_the_bits(seed):
    chance = np.random.default_rng(seed)
    order = np.argsort(TIME + chance.uniform(0.0, 0.15, 300), kind="stable")
    whole = means(TIME, VALUE)
    cuts = np.sort(chance.choice(300, 20, replace=False))
    assert means(TIME[order], VALUE[order], cuts) == means(TIME[order], VALUE[order])
    assert means(TIME[order], VALUE[order]) == whole


def test_late_readings_are_counted_and_not_used():
    time, value = np.append(TIME, 1.0), np.append(VALUE, 1e6)
    found, counters = means(time, value)
    assert found == means(TIME, VALUE)[0] and counters.late == 1


def test_doubled_readings_count_once():
    time, value = np.repeat(TIME, 2), np.repeat(VALUE, 2)
    found, counters = means(time, value)
    assert found == means(TIME, VALUE)[0] and counters.doubled == 300


def test_an_outlier_is_left_out_and_a_step_is_not():
    wild = VALUE.copy()
    wild[104] = 50.0
    found, counters = means(TIME, wild)
    assert counters.outlying == 1 and found[10][1] == pytest.approx(5.0, abs=0.1)
    stepped = np.where(TIME < 1.05, VALUE, VALUE + 50.0)
    assert means(TIME, stepped)[1].outlying == 0


def test_a_single_stamp_in_the_future_does_not_make_others_late():
    time = TIME.copy()
    time[120] += 3600.0
    for cuts in ((), (120,), (121,)):
        found, counters = means(time, VALUE, cuts)
        assert len(found) == 30 and counters.late == 0 and counters.ahead == 1


def test_a_gap_is_not_a_wrong_stamp():
    time = np.where(TIME < 1.5, TIME, TIME + 3600.0)
    for cuts in ((), (150,), (151,)):
        found, counters = means(time, VALUE, cuts)
        assert len(found) == 30 and counters.ahead == 0
