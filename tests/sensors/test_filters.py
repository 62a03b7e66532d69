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
