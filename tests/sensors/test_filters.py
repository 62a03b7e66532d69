"""Samples of a sensor: no aliases, its own resonance, against the responses of tones."""

import math

import numpy as np
import pytest

from planetary_twin_py.sensors.filters import Path, sampled, unchanged
from planetary_twin_py.sensors.mode import Mode

RATE, RATIO = 200_000.0, 4
TIME = np.arange(40_000) / RATE


def line(tone, at, response=unchanged, decay=0.0, path=unchanged):
    """Amplitude at a frequency in the samples that a sensor takes of a tone of 1 m/s^2."""
    signal = np.cos(math.tau * tone * TIME + 0.3)
    values, first = sampled([Path(signal, path, 0.0)], response, decay, RATE, RATIO)
    time = TIME[first::RATIO][: len(values)]
    whole = len(time) // 50 * 50  # of 1 ms, in which every tone has whole periods
    turning = np.exp(-1j * math.tau * at * time[:whole])
    return 2.0 * abs(np.mean(values[:whole] * turning))


@pytest.mark.parametrize("tone, alias", [(40_000.0, 10_000.0), (45_000.0, 5_000.0)])
def test_a_tone_above_the_sensor_leaves_no_alias(tone, alias):
    assert line(tone, alias) < 1e-3


@pytest.mark.parametrize("tone", [1000.0, 9000.0, 20_000.0])
def test_a_tone_within_the_band_keeps_its_size(tone):
    assert line(tone, tone) == pytest.approx(1.0, abs=0.01)


def test_a_resonance_raises_what_is_below_it():
    """5 % at 0.218 of 20 kHz with a damping ratio of 0.02: |1 / (1 - x^2 + 2 i zeta x)|."""
    mode = Mode(math.tau * 20_000.0, 0.02)
    for tone in (1000.0, 4000.0, 12_000.0):
        x = tone / 20_000.0
        expected = 1.0 / abs(1.0 - x**2 + 0.04j * x)
        found = line(tone, tone, mode.displacement, mode.decay)
        assert found == pytest.approx(expected, rel=2e-3)
    assert abs(mode.displacement(np.array([0.218 * mode.frequency]))[0]) == pytest.approx(
        1.05, abs=1e-3
    )


def test_samples_are_those_of_their_time():
    """Delays are taken out: a tone keeps its phase."""
    signal = np.cos(math.tau * 1000.0 * TIME)
    values, first = sampled([Path(signal, unchanged, 0.0)], unchanged, 0.0, RATE, RATIO)
    assert values == pytest.approx(signal[first::RATIO][: len(values)], abs=2e-3)
    assert len(TIME) - first - RATIO * len(values) <= first + RATIO
