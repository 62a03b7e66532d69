"""Tones above half the sample rate: where they stand, and that readers are warned."""

import math

import numpy as np
import pytest
from tiers import first

import planetary_twin_py as pt
from planetary_twin_py.analysis.lines.mesh_spectrum import frequency_spectrum_of, order_spectrum_of
from planetary_twin_py.analysis.sampling.aliases import (
    NEGLIGIBLE,
    alias_frequency,
    alias_share,
    aliased_harmonic,
    edge_amplitude,
)
from planetary_twin_py.analysis.signals.signal import Signal
from planetary_twin_py.analysis.spectra.spectrum import amplitude_spectrum, strongest_lines

PAPER = pt.load_scene("paper")


@pytest.mark.parametrize("tone", [10_300.0, 19_000.0, 20_700.0, 33_300.0])
def test_a_sampled_tone_appears_at_its_alias(tone):
    time = np.arange(20_000) / 20_000.0
    (line,) = strongest_lines(
        *amplitude_spectrum(np.sin(2.0 * np.pi * tone * time + 0.3), 20_000.0), 1
    )
    assert line.place == pytest.approx(alias_frequency(tone, 20_000.0), abs=0.01)
    assert line.amplitude == pytest.approx(1.0, rel=1e-3)


def test_harmonic_behind_an_alias_is_found_and_none_elsewhere():
    # 2700 Hz: 4 x is 10 800 and folds to 9200, 5 x is 13 500 and folds to 6500
    assert aliased_harmonic(9200.0, 2700.0, 20_000.0, 5.0) == 4
    assert aliased_harmonic(6500.0, 2700.0, 20_000.0, 5.0) == 5
    assert aliased_harmonic(9300.0, 2700.0, 20_000.0, 5.0) is None
    assert aliased_harmonic(2700.0, 2700.0, 20_000.0, 5.0) is None


def signal_of(speed, rate, duration=0.2):
    run = pt.simulate(PAPER.replace(input_speed=speed), duration, rate, settling=0.2)
    return Signal(run.dte[:, 0], run.time, run.angle[:, 0], None)


@pytest.fixture(scope="module")
def fast():
    """6000 rpm, meshing at 3000 Hz, of which half of 50 kHz carries eight harmonics."""
    return signal_of(pt.rpm(6000), 50_000.0)


@pytest.mark.parametrize("spectrum_of", first(1, [order_spectrum_of, frequency_spectrum_of]))
def test_lines_of_fast_run_that_are_no_harmonics_are_folded_ones(fast, spectrum_of):
    """Against the same run at 1 MHz, which has no line there."""
    found = spectrum_of(fast, 30)
    foreign = [line for line in found.lines(12) if found.harmonic(line.place) is None]
    assert {found.alias(line) for line in foreign} >= {9, 10, 11, 12}
    assert found.alias_share > NEGLIGIBLE
    fine = frequency_spectrum_of(signal_of(pt.rpm(6000), 1e6), 30)
    assert fine.alias_share <= NEGLIGIBLE
    assert all(fine.harmonic(line.place) for line in fine.lines(12))
    assert not any(fine.alias(line) for line in fine.lines(12))


def test_lines_that_may_be_aliases_are_marked():
    """At 1000 rpm and 20 kHz harmonic 23 folds onto 17, 22 onto 18, 21 onto 19."""
    found = frequency_spectrum_of(signal_of(pt.rpm(1000), 20_000.0), 30)
    named = {found.harmonic(line.place): found.alias(line) for line in found.lines(19)}
    assert {own: named[own] for own in (17, 18, 19)} == {17: 23, 18: 22, 19: 21}
    assert named[1] is None  # far above what folds back


def test_amplitudes_at_half_the_rate_estimate_the_aliased_ones():
    """The height of lines beyond half of 20 and 50 kHz, from samples at 1 MHz."""
    fine = frequency_spectrum_of(signal_of(pt.rpm(1000), 1e6), 30)
    for rate in (20_000.0, 50_000.0):
        seen = frequency_spectrum_of(signal_of(pt.rpm(1000), rate), 30)
        beyond = fine.amplitude[fine.axis > 0.5 * rate].max()
        assert 0.5 < seen.edge / beyond < 6.0


def test_samples_that_carry_a_signal_are_not_remarked_upon():
    frequency = np.linspace(0.0, 100.0, 101)
    amplitude = np.exp(-frequency / 10.0)
    assert edge_amplitude(frequency, amplitude) == pytest.approx(math.exp(-8.0))
    assert alias_share(frequency, amplitude) <= NEGLIGIBLE < alias_share(frequency, amplitude + 0.1)
    assert alias_share(frequency, np.zeros(101)) == 0.0
