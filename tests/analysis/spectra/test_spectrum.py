"""Spectra of signals whose lines, powers and means are known."""

import numpy as np
import pytest

import planetary_twin_py as pt

RATE = 50_000.0


def tone(amplitude, frequency, count, rate=RATE, phase=0.3):
    return amplitude * np.sin(2 * np.pi * frequency * np.arange(count) / rate + phase)


@pytest.mark.parametrize("window", ["boxcar", "hann", "flattop", "blackman"])
@pytest.mark.parametrize("count", [1000, 1001])
def test_a_tone_on_a_bin_has_its_amplitude_whatever_the_window(window, count):
    frequency = 37 * RATE / count
    found = pt.amplitude_spectrum(tone(3.0, frequency, count), RATE, window)
    peak = found.amplitude.argmax()
    assert found.frequency[peak] == pytest.approx(frequency, rel=1e-12)
    assert found.amplitude[peak] == pytest.approx(3.0, rel=1e-9)
    assert found.amplitude[np.abs(np.arange(len(found.amplitude)) - peak) > 4].max() < 1e-9


@pytest.mark.parametrize("offset", [0.1, 0.5, 0.77])
def test_between_bins_hann_loses_15_percent_flat_top_none(offset):
    signal = tone(2.0, (150 + offset) * 10.0, 5000)
    hann, flat = (pt.amplitude_spectrum(signal, RATE, w).amplitude for w in ("hann", "flattop"))
    assert 0.845 * 2.0 < hann.max() < 2.0
    assert flat.max() == pytest.approx(2.0, rel=2e-3)


@pytest.mark.parametrize("offset", [0.0, 0.1, 0.4, 0.5, 0.77])
def test_the_line_of_a_tone_between_bins_is_exact(offset):
    frequency = (150 + offset) * 10.0
    spectrum = pt.amplitude_spectrum(5.0 + tone(2e-6, frequency, 5000), RATE)
    (line,) = pt.strongest_lines(*spectrum, count=1)
    assert line.place == pytest.approx(frequency, abs=1e-3 * 10.0)
    assert line.amplitude == pytest.approx(2e-6, rel=1e-4)


def test_two_tones_five_bins_apart_are_separate_lines():
    signal = tone(1.0, 2003.0, 5000) + tone(0.2, 2053.0, 5000, phase=1.1)
    lines = pt.strongest_lines(*pt.amplitude_spectrum(signal, RATE), count=2)
    assert [line.place for line in lines] == pytest.approx([2003.0, 2053.0], abs=1.0)
    assert [line.amplitude for line in lines] == pytest.approx([1.0, 0.2], rel=0.01)


@pytest.mark.parametrize("count", [999, 1000])
def test_the_mean_is_at_zero_hertz_and_nowhere_else(count):
    amplitude = pt.amplitude_spectrum(np.full(count, -4.0), RATE).amplitude
    assert amplitude[0] == 4.0
    assert np.all(amplitude[1:] == 0.0)


@pytest.mark.parametrize("cycles", [20.3, 20.5, 150.5])
def test_tone_with_part_of_cycle_has_no_second_line_in_first_bin(cycles):
    signal = 3.0 + tone(1.0, cycles, 4000, rate=4000.0)
    amplitude = pt.amplitude_spectrum(signal, 4000.0).amplitude
    # Both signs of the frequency leak there, and into the mean.
    assert amplitude[1] < 4.0 / (np.pi * (cycles - 1.0) ** 3)


@pytest.mark.parametrize("count", [1023, 1024])
def test_squares_of_amplitudes_add_up_to_the_power(count):
    samples = np.random.default_rng(1).normal(0.5, 2.0, count)
    amplitude = pt.amplitude_spectrum(samples, RATE, "boxcar").amplitude
    share = np.full(len(amplitude), 0.5)
    share[0] = 1.0
    if count % 2 == 0:
        share[-1] = 1.0
    assert np.sum(share * amplitude**2) == pytest.approx(np.mean(samples**2), rel=1e-12)


def test_density_adds_up_to_variance_and_is_flat_for_white_noise():
    samples = np.random.default_rng(1).normal(7.0, 2.0, 1 << 17)
    found = pt.power_density(samples, RATE, segment=1024)
    assert found.density.sum() * found.frequency[1] == pytest.approx(4.0, rel=0.01)
    inner = found.density[2:-2]
    assert np.allclose(inner, 4.0 / (0.5 * RATE), rtol=0.4)


def test_channels_are_columns():
    signal = np.column_stack((tone(1.0, 1000.0, 5000), tone(3.0, 2000.0, 5000)))
    amplitude = pt.amplitude_spectrum(signal, RATE).amplitude
    assert amplitude[100, 0] == pytest.approx(1.0)
    assert amplitude[200, 1] == pytest.approx(3.0)
    assert pt.power_density(signal, RATE).density.shape[1] == 2


@pytest.mark.parametrize(
    ("call", "reason"),
    [
        (
            lambda s: pt.amplitude_spectrum([1.0, 2.0], RATE),
            "samples: 2 values: must be at least 8",
        ),
        (lambda s: pt.amplitude_spectrum([*s[:5], np.nan, *s], RATE), "not finite at index 5"),
        (lambda s: pt.amplitude_spectrum(s, 0.0), "sample_rate = 0: must be positive"),
        (lambda s: pt.amplitude_spectrum(s, RATE, "hanning?"), "window = 'hanning.': must be"),
        (lambda s: pt.power_density(s, RATE, 101), "segment = 101: must be within 8 and 100"),
        (lambda s: pt.strongest_lines(s, s, 0), "count = 0"),
    ],
)
def test_misuse_ends_in_one_line_that_names_it(call, reason):
    with pytest.raises(ValueError, match=reason) as caught:
        call(np.arange(100.0))
    assert "\n" not in str(caught.value)
