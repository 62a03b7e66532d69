"""Levels of signals whose levels are known."""

import math

import numpy as np
import pytest

from planetary_twin_py.sensors.levels import INTERVAL, LevelMeter

RATE, MESH = 20_000.0, 730.0  # [Hz]
COUNT = round(RATE * INTERVAL)


def levels_of(values, mesh=MESH, first=0, part=COUNT, limit=None):
    """Levels of samples that arrive in parts."""
    meter, found = LevelMeter(1.0 / RATE, limit), []
    meter.turn(0.0, (first + len(values)) / RATE, mesh)
    for begin in range(0, len(values), part):
        found += meter.add(first + begin, values[begin : begin + part])
    return found


def tone(amplitude, frequency, seconds=INTERVAL):
    return amplitude * np.sin(2.0 * math.pi * frequency * np.arange(seconds * RATE) / RATE + 0.3)


def test_a_tone_at_the_mesh_frequency_has_closed_levels():
    (found,) = levels_of(4.0 + tone(2.0, MESH))
    assert found.end == pytest.approx(INTERVAL) and found.interval == pytest.approx(INTERVAL)
    assert found.mean == pytest.approx(4.0, abs=1e-9)
    assert found.rms == pytest.approx(math.sqrt(2.0), rel=1e-9)
    assert found.kurtosis == pytest.approx(1.5, rel=1e-9)
    assert found.peak == pytest.approx(2.0, rel=1e-3)
    assert found.mesh_line == pytest.approx(2.0, rel=1e-9)


def test_a_line_elsewhere_is_not_the_mesh_line():
    (found,) = levels_of(tone(2.0, MESH + 50.0) + tone(0.01, MESH))
    assert found.mesh_line == pytest.approx(0.01, rel=0.02)


def test_the_line_follows_a_speed_that_varies():
    seconds = np.arange(COUNT) / RATE
    cycles = MESH * seconds + 0.5 * 2000.0 * seconds**2  # from 730 to 930 Hz
    meter = LevelMeter(1.0 / RATE, None)
    for begin in np.arange(0.0, INTERVAL, 0.01):
        meter.turn(begin, begin + 0.01, MESH + 2000.0 * (begin + 0.005))
    samples = 3.0 * np.cos(2.0 * math.pi * cycles)
    (found,) = meter.add(0, samples)
    assert found.mesh_line == pytest.approx(3.0, rel=0.01)


def test_normal_noise_has_a_kurtosis_of_three():
    noise = np.random.default_rng(3).standard_normal(50 * COUNT)
    kurtosis = [one.kurtosis for one in levels_of(noise)]
    # The standard error of one is the root of 24/n.
    assert np.mean(kurtosis) == pytest.approx(3.0, abs=4.0 * math.sqrt(24.0 / len(noise)))


@pytest.mark.parametrize("part", [1, 7, 256, 5000])
def test_levels_do_not_depend_on_the_parts(part):
    samples = np.random.default_rng(1).standard_normal(2 * COUNT + 50)
    np.testing.assert_array_equal(levels_of(samples, part=part), levels_of(samples))


def test_an_interval_that_began_before_is_left_out():
    found = levels_of(np.random.default_rng(1).standard_normal(2 * COUNT), first=COUNT // 2)
    assert [one.end for one in found] == pytest.approx([2.0 * INTERVAL])


def test_constant_samples_have_no_kurtosis():
    (found,) = levels_of(np.full(COUNT, 0.1))
    assert found.rms == pytest.approx(0.0, abs=1e-15) and math.isnan(found.kurtosis)


@pytest.mark.parametrize("mesh", [0.0, 20.0, 0.45 * RATE])
def test_a_mesh_frequency_out_of_reach_has_no_line(mesh):
    (found,) = levels_of(tone(1.0, 100.0), mesh=mesh)
    assert math.isnan(found.mesh_line) and found.rms > 0.5


def test_samples_at_the_ends_of_the_range_are_counted():
    samples = np.clip(tone(1.0, 100.0), -0.9, 0.9)
    (found,) = levels_of(samples, limit=0.9)
    assert found.clipped == np.count_nonzero(np.abs(samples) == 0.9) > 100
    assert levels_of(samples)[0].clipped == 0


def test_intervals_restart_after_a_gap():
    meter = LevelMeter(1.0 / RATE, None)
    meter.turn(0.0, 1.0, MESH)
    assert meter.add(0, tone(1.0, MESH, 0.5 * INTERVAL)) == []
    later = tone(2.0, MESH, 2.0 * INTERVAL)
    found = meter.add(3 * COUNT + 100, later)
    assert [round(one.end / INTERVAL) for one in found] == [5]
    assert found[0].mesh_line == pytest.approx(2.0, rel=1e-3)
