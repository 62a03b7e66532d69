"""Stuck and clipped signals are reported, and no sound signal of any quantisation."""

import numpy as np
import pytest

from planetary_twin_py.recording.tables.sensor_faults import fault_remarks

TIME = np.arange(40_000) / 20_000.0
NOISE = np.random.default_rng(0).standard_normal(len(TIME))
SIGNAL = 3.0 * np.sin(2.0 * np.pi * 584.3 * TIME) + 0.3 * NOISE


def remarks(samples):
    return list(fault_remarks(TIME, samples))


@pytest.mark.parametrize("level", [1e-9, 1e-3, 0.1, 1.0])
@pytest.mark.parametrize("length", [400, 20_000])
def test_a_stuck_sensor_is_reported_with_its_interval(level, length):
    samples = level * np.round(SIGNAL / level)
    samples[10_000 : 10_000 + length] = level
    samples[[9_999, 10_000 + length]] = 0.0
    (line,) = remarks(samples)
    assert line.startswith(f"{length} successive samples are exactly")
    assert "from 0.5 to" in line and "stuck" in line


@pytest.mark.parametrize("bound", [1.0, 2.0, 2.9])
def test_clipping_is_reported_with_the_share_of_the_samples(bound):
    low, high = remarks(np.clip(SIGNAL, -bound, bound))
    share = np.mean(-bound >= SIGNAL)
    assert float(low.split()[0]) == pytest.approx(share, rel=0.1)
    assert "exactly at the lowest value" in low and "exactly at the highest value" in high


@pytest.mark.parametrize("level", [1e-9, 1e-3, 0.1, 0.5, 1.0, 3.0])
@pytest.mark.parametrize("frequency", [0.7, 5.0, 584.3, 1000.0, 5000.0])
@pytest.mark.parametrize("noise", [0.0, 0.3, 3.0])
@pytest.mark.parametrize("phase", [0.0, 1.5])
def test_sound_signals_of_any_quantisation_are_not_reported(level, frequency, noise, phase):
    tone = 3.0 * np.sin(2.0 * np.pi * frequency * TIME + phase) + noise * NOISE
    assert remarks(level * np.round(tone / level)) == []
    assert remarks(level * np.floor(tone / level)) == []


def test_samples_that_a_logger_repeats_are_not_stuck():
    assert remarks(np.repeat(SIGNAL[:2000], 20)) == []


def test_a_constant_signal_is_not_reported():
    assert remarks(np.zeros(len(TIME))) == []


@pytest.mark.parametrize("code", [-9999.0, 32767.0, 9.9e37])
def test_codes_for_missing_samples_are_reported_with_their_time(code):
    samples = SIGNAL.copy()
    samples[10_000:10_007] = code
    (line,) = remarks(samples)
    assert line.startswith("7 samples are codes") and f"the first is {code:.6g} at 0.5 s" in line
