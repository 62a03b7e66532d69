"""Envelope, cepstrum and spectral kurtosis of signals whose values are known."""

import numpy as np
import pytest

import planetary_twin_py as pt

N = 8192
TURN = 2.0 * np.pi * np.arange(N) / N


def test_the_envelope_of_a_modulated_carrier_is_its_modulation():
    signal = 0.5 + (1.0 + 0.4 * np.cos(8.0 * TURN)) * np.cos(900.0 * TURN)
    assert pt.envelope(signal, N) == pytest.approx(1.0 + 0.4 * np.cos(8.0 * TURN))


@pytest.mark.parametrize("m", [0.2, 0.5])
def test_the_squared_envelope_has_the_lines_of_the_modulation(m):
    """(1 + m cos)^2 = 1 + m^2/2 + 2 m cos + m^2/2 cos 2."""
    signal = (1.0 + m * np.cos(8.0 * TURN)) * np.cos(900.0 * TURN)
    found = pt.squared_envelope_spectrum(signal, N)
    assert found.frequency[[8, 16]] == pytest.approx([8.0, 16.0])
    expected = [1.0 + m**2 / 2.0, 2.0 * m, m**2 / 2.0]
    assert found.amplitude[[0, 8, 16]] == pytest.approx(expected, rel=1e-6)
    assert found.amplitude[32:].max() < 1e-9


def test_only_the_band_is_demodulated():
    mains = 3.0 * np.cos(50.0 * TURN)
    impacts = (1.0 + np.cos(8.0 * TURN)) * np.cos(900.0 * TURN)
    found = pt.squared_envelope_spectrum(mains + impacts, N, (850.0, 950.0))
    assert found.amplitude[8] == pytest.approx(2.0, rel=1e-6)
    for band in ((950.0, 850.0), (0.0, 5000.0), (900.2, 900.4)):
        with pytest.raises(ValueError, match="must be within 0 and 4096"):
            pt.envelope(mains, N, band)


def test_an_echo_has_its_lines_in_the_cepstrum():
    """ln(1 + a z) = a z - a^2 z^2/2 + a^3 z^3/3, half of it at each side."""
    signal = np.zeros(4096)
    signal[0], signal[100] = 1.0, 0.5
    found = pt.real_cepstrum(signal)
    assert found[[100, 200, 300]] == pytest.approx([0.25, -0.0625, 0.0208333], abs=1e-6)
    assert abs(found[50]) < 1e-12


def test_a_whitened_signal_has_the_magnitude_1_everywhere_and_its_phases():
    signal = np.random.default_rng(3).normal(size=1001).cumsum()
    found = pt.pre_whitened(signal)
    spectrum, before = np.fft.rfft(found), np.fft.rfft(signal)
    assert np.abs(spectrum) == pytest.approx(np.ones(501), abs=1e-12)
    assert np.angle(spectrum * np.conj(before)) == pytest.approx(np.zeros(501), abs=1e-9)
    assert len(found) * np.mean(found**2) == pytest.approx(1.0)


def test_impacts_come_out_of_tones_by_whitening():
    random = np.random.default_rng(4)
    impacts = np.zeros(N)
    impacts[::512] = 1.0
    signal = 20.0 * np.cos(900.3 * TURN) + impacts + 0.05 * random.normal(size=N)

    def kurtosis(values):
        return np.mean((values - values.mean()) ** 4) / values.var() ** 2

    assert kurtosis(signal) < 1.6
    assert kurtosis(pt.pre_whitened(signal)) > 6.0


@pytest.mark.parametrize("function", [pt.real_cepstrum, pt.pre_whitened])
def test_a_spectrum_with_a_zero_is_refused(function):
    with pytest.raises(ValueError, match="their spectrum is zero in bin 0"):
        function(np.zeros(64))
    with pytest.raises(ValueError, match="their spectrum is zero in bin 1, but for rounding"):
        function(1.0 + np.cos(10 * TURN))


def test_spectral_kurtosis_is_0_of_gauss_and_minus_1_of_a_tone():
    noise = np.random.default_rng(6).normal(size=1 << 19)
    found = pt.spectral_kurtosis(noise, 1.0)
    spread = 2.0 / np.sqrt(found.segments)
    assert found.kurtosis.std() == pytest.approx(spread, rel=0.25)
    assert np.abs(found.kurtosis).max() < 6.0 * spread
    time = np.arange(1 << 14)
    tone = pt.spectral_kurtosis(np.cos(2.0 * np.pi * 32.0 / 256.0 * time), 256.0)
    assert tone.kurtosis[tone.frequency == 32.0] == pytest.approx([-1.0])


@pytest.mark.parametrize("share", [0.1, 0.25])
def test_spectral_kurtosis_of_intermittent_noise_is_that_of_its_share(share):
    """2/q - 2; windows at the ends of a burst contain a part of it, so bursts are long."""
    noise = np.random.default_rng(7).normal(size=1 << 20)
    present = np.arange(1 << 20) % 65536 < share * 65536
    found = pt.spectral_kurtosis(noise * present, 1.0, 128)
    assert found.kurtosis.mean() == pytest.approx(2.0 / share - 2.0, rel=0.04)


def test_short_records_have_no_spectral_kurtosis():
    with pytest.raises(ValueError, match="segment = 256: 6 segments in 1000 samples"):
        pt.spectral_kurtosis(np.arange(1000.0), 1.0)
    with pytest.raises(ValueError, match="segment = 31: must be even"):
        pt.spectral_kurtosis(np.arange(1000.0), 1.0, 31)
    assert np.isnan(pt.spectral_kurtosis(np.zeros(4096), 1.0).kurtosis).all()
