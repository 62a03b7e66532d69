"""Tones whose stamps drift keep their amplitudes, and rounded stamps are no drift."""

import numpy as np
import pytest

from planetary_twin_py.analysis.lines.varying_speed import exact_order
from planetary_twin_py.analysis.sampling.even_steps import at_equal_steps, drifts, resampled
from planetary_twin_py.analysis.sampling.interpolation import EXACT, interpolated
from planetary_twin_py.analysis.spectra.spectrum import amplitude_spectrum, strongest_lines

RATE, COUNT = 10_000.0, 20_000


def stamps(drift):
    """Stamps of a clock whose rate changes by the share `drift` in the record."""
    number = np.arange(COUNT)
    return np.cumsum(1.0 + drift * (number / COUNT - 0.5)) / RATE


def amplitude(samples, time):
    """Of the strongest line."""
    return strongest_lines(*amplitude_spectrum(samples, (len(time) - 1) / np.ptp(time)))[
        0
    ].amplitude


@pytest.mark.parametrize("drift", [0.0, 3e-5, 1e-4, 1e-3, 0.05])
@pytest.mark.parametrize("share", [0.01, 0.25, 0.45])
def test_line_at_drifting_stamps_has_its_amplitude_to_1_percent(drift, share):
    time = stamps(drift)
    tone = np.sin(2.0 * np.pi * share * RATE * time + 0.3)
    even = resampled(tone, time) if drifts(time) else tone
    assert amplitude(even, at_equal_steps(time)) == pytest.approx(1.0, rel=0.01)


def test_beyond_the_bound_drift_lowers_the_highest_line():
    """A sinusoidal drift with rms phase P at half the rate: its line is J_0(sqrt(2) P) high."""
    number = np.arange(COUNT)
    for phase, beyond in ((0.12, False), (0.16, True)):
        late = np.sqrt(2.0) * phase / np.pi * np.sin(2.0 * np.pi * 9.0 * number / COUNT)
        time = (number + late) / RATE
        tone = np.sin(2.0 * np.pi * 0.499 * RATE * time)
        assert drifts(time) == beyond
        assert (amplitude(tone, time) < 0.99) == beyond


@pytest.mark.parametrize("acceleration", [0.02, -0.5])
def test_varying_speed_lowers_line_at_exact_order_by_1_percent(acceleration):
    time = np.arange(COUNT) / RATE
    angle = 2.0 * np.pi * (10.0 * time + 0.5 * acceleration * time**2)
    tone = np.sin(exact_order(angle) * angle)
    assert amplitude(tone, time) == pytest.approx(0.99, abs=3e-3)  # interpolated as one tone
    assert exact_order(20.0 * np.pi * time) > 1e6


def test_stamps_rounded_to_a_tenth_of_a_step_do_not_drift():
    assert not drifts(np.round(10.0 * (0.123 + 1.03 * np.arange(COUNT))) / 10.0)


@pytest.mark.parametrize("share", [0.001, 0.25, 0.4, EXACT])
def test_a_tone_between_its_samples_is_exact_to_a_thousandth(share):
    places = np.linspace(100.0, COUNT - 100.0, 7777)
    number = np.arange(COUNT)
    found = interpolated(np.stack([np.sin(2.0 * np.pi * share * number), number], 1), places)
    assert np.abs(found[:, 0] - np.sin(2.0 * np.pi * share * places)).max() < 2e-3
    assert found[:, 1] == pytest.approx(places, rel=1e-9)
