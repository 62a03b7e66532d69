"""Samples of a sensor: no aliases, its own resonance, against the responses of tones."""

import math

import numpy as np
import pytest

from planetary_twin_py.sensors.filters import (
    DERIVATIVE,
    SECOND_DERIVATIVE,
    UNCHANGED,
    Decimator,
    Response,
)
from planetary_twin_py.sensors.mode import Mode
from sensors.prescribed import line

RATE, RATIO = 200_000.0, 4
TIME = np.arange(40_000) / RATE


def response_of(mode):
    return Response(mode.displacement, (mode,))


def filtered(tone, response=UNCHANGED, ratio=RATIO):
    """Samples that a sensor takes of a tone of 1 m/s^2, and the number of the first one."""
    decimator = Decimator(response, RATE, ratio, 0)
    first = decimator.next
    return decimator.take(np.cos(math.tau * tone * TIME + 0.3)), first


def amplitude(tone, at, response=UNCHANGED, ratio=RATIO):
    return abs(line(filtered(tone, response, ratio)[0], RATE / ratio, at))


@pytest.mark.parametrize("tone, alias", [(40_000.0, 10_000.0), (45_000.0, 5_000.0)])
def test_a_tone_above_the_sensor_leaves_no_alias(tone, alias):
    assert amplitude(tone, alias) < 1e-3


@pytest.mark.parametrize("ratio", [4, 5, 8, 25])
def test_what_the_filter_stops_is_80_db_down_at_all_ratios(ratio):
    rate = RATE / ratio
    for share in (0.61, 0.75, 1.0, 1.3):
        tone = share * rate
        assert amplitude(tone, abs(tone - rate), ratio=ratio) < 2e-4


@pytest.mark.parametrize("tone", [1000.0, 9000.0, 20_000.0])
def test_a_tone_within_the_band_keeps_its_size(tone):
    assert amplitude(tone, tone) == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("ratio", [4, 7, 16])
@pytest.mark.parametrize(
    "resonance, damping_ratio",
    [(20_000.0, 0.02), (3000.0, 0.02), (3000.0, 0.5), (79_000.0, 0.02), (150_000.0, 0.02)],
)
def test_a_resonance_is_that_of_a_mass_on_a_spring(resonance, damping_ratio, ratio):
    """|1 / (1 - x^2 + 2 i zeta x)|, whether it is a recursion or within the filter."""
    mode = Mode(math.tau * resonance, damping_ratio)
    for tone in (500.0, 2800.0, 0.4 * RATE / ratio):
        x = tone / resonance
        expected = 1.0 / abs(1.0 - x**2 + 2j * damping_ratio * x)
        found = amplitude(tone, tone, response_of(mode), ratio)
        assert found == pytest.approx(expected, rel=1e-3)


def test_a_resonance_of_20_khz_raises_4_37_khz_by_5_percent():
    mode = Mode(math.tau * 20_000.0, 0.02)
    assert amplitude(4370.0, 4370.0, response_of(mode)) == pytest.approx(1.05, abs=1e-3)


@pytest.mark.parametrize("derivative, order", [(DERIVATIVE, 1), (SECOND_DERIVATIVE, 2)])
@pytest.mark.parametrize("tone", [100.0, 3000.0, 19_900.0])
def test_a_derivative_has_the_amplitude_and_phase_of_a_tone(derivative, order, tone):
    values, first = filtered(tone, derivative)
    omega = math.tau * tone
    expected = np.exp(0.3j) * (1j * omega) ** order * np.exp(1j * omega * first * RATIO / RATE)
    found = line(values, RATE / RATIO, tone)
    assert abs(found - expected) < 1e-3 * omega**order


def test_samples_are_those_of_their_time():
    """Delays are taken out: a tone keeps its phase."""
    values, first = filtered(1000.0)
    expected = np.cos(math.tau * 1000.0 * TIME + 0.3)[first * RATIO :: RATIO][: len(values)]
    assert values == pytest.approx(expected, abs=1e-3)


def test_a_start_is_forgotten_before_the_first_sample():
    """A constant since ever and one that starts with the first sample look the same."""
    mode = Mode(math.tau * 2000.0, 0.05)
    for response in (UNCHANGED, response_of(mode)):
        values = Decimator(response, RATE, RATIO, 0).take(np.ones(len(TIME)))
        assert values == pytest.approx(1.0, abs=5e-4)


@pytest.mark.parametrize("size", [1, 7, 1000])
def test_values_do_not_depend_on_what_is_given_at_once(size):
    mode, chance = Mode(math.tau * 9000.0, 0.02), np.random.default_rng(1)
    signal = chance.standard_normal(4000)
    whole = Decimator(response_of(mode), RATE, RATIO, 5).take(signal)
    parted = Decimator(response_of(mode), RATE, RATIO, 5)
    parts = [parted.take(part) for part in np.split(signal, range(size, 4000, size))]
    assert np.array_equal(whole, np.concatenate(parts)) and len(whole) > 500
