"""Every condition indicator against its closed form, and where it is not defined."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.analysis.gears.mesh_band import mesh_band

Z = 30
TURN = 2.0 * np.pi * np.arange(64 * Z) / (64 * Z)
CARRIER = np.cos(Z * TURN)


def modulated(m):
    return (1.0 + m * np.cos(TURN)) * CARRIER


def of(average, **how):
    return pt.condition_indicators(average, Z, **how)


def exactly(value):
    return pytest.approx(value, rel=1e-6)


@pytest.mark.parametrize("m", [0.2, 0.5])
def test_a_modulated_carrier_has_closed_forms(m):
    found, power = of(modulated(m)), 1.0 + m**2 / 2.0
    assert found.rms == exactly(math.sqrt(power / 2.0))
    assert found.peak == exactly(1.0 + m)
    assert found.crest_factor == exactly((1.0 + m) * math.sqrt(2.0 / power))
    assert found.kurtosis == exactly(1.5 * (1.0 + 3.0 * m**2 + 3.0 * m**4 / 8.0) / power**2)
    assert found.fm0 == exactly(2.0 + m + m * math.cos(math.pi / Z))
    assert found.nb4 == exactly(1.5)
    assert found.sideband_index == exactly(m / 2.0)
    assert found.sideband_level_factor == exactly(m * math.sqrt(2.0 / power))
    assert found.sideband_energy_ratio == exactly(m)
    for name in ("fm4", "m6a", "m8a", "energy_ratio"):
        assert math.isnan(getattr(found, name))
        assert found.reasons[name].startswith("no difference signal")


def test_figures_of_a_modulated_carrier_are_those_published():
    """Numbers of the same closed forms, typed by hand."""
    slight, strong = of(modulated(0.2)), of(modulated(0.5))
    assert (slight.kurtosis, strong.kurtosis) == (exactly(1.615629), exactly(2.101852))
    assert slight.fm0 == exactly(2.398904)
    assert strong.crest_factor == exactly(2.0)
    assert slight.sideband_level_factor == exactly(0.28005602)
    assert strong.sideband_level_factor == exactly(0.66666667)


def test_a_pure_tone_leaves_only_what_is_defined():
    found = of(CARRIER)
    assert (found.crest_factor, found.kurtosis) == (exactly(math.sqrt(2.0)), exactly(1.5))
    assert found.fm0 == exactly(2.0)
    undefined = {"fm4", "m6a", "m8a", "na4", "na4_star", "nb4", "energy_ratio", "energy_operator"}
    assert set(found.reasons) == undefined
    assert all(math.isnan(getattr(found, name)) for name in undefined)


def test_square_triangle_and_gauss_have_their_kurtosis():
    square = np.where(np.arange(64 * Z) % 64 < 32, 1.0, -1.0)
    assert of(square).kurtosis == exactly(1.0)
    fine = np.abs(np.linspace(-1.0, 1.0, 64 * Z * 50, endpoint=False))
    assert of(fine).kurtosis == pytest.approx(1.8, rel=1e-6)
    gauss = of(np.random.default_rng(2).normal(size=200_000))
    spread = math.sqrt(24.0 / 200_000)
    assert gauss.kurtosis == pytest.approx(3.0, abs=4.0 * spread)
    # Orders 1, 2, 29, 30, ... are 7 % of all, and the rest is as Gaussian.
    assert gauss.fm4 == pytest.approx(3.0, abs=4.0 * spread)
    assert gauss.m6a == pytest.approx(15.0, rel=0.05)
    assert gauss.m8a == pytest.approx(105.0, rel=0.15)


def test_second_sidebands_are_the_difference():
    """cos 2t cos Zt has m4/m2^2 = (3/2)^2, m6/m2^3 = (5/2)^2, m8/m2^4 = (35/8)^2."""
    found = of(CARRIER + 0.1 * np.cos(2.0 * TURN) * CARRIER)
    assert found.fm4 == exactly(2.25)
    assert found.m6a == exactly(6.25)
    assert found.m8a == exactly(19.140625)
    assert found.energy_ratio == exactly(0.0707107)
    assert found.sideband_index == pytest.approx(0.0, abs=1e-12)


def test_a_short_burst_has_the_moments_of_its_duty():
    """A Hann burst of noise-free carrier over a share w of the turn: FM4 = 35/(12 w).

    Means of sin^(4k) over a period are C(4k, 2k)/16^k: 3/8, 35/128, and those of the carrier 1/2,
    3/8. So m4/m2^2 = (35/128 x 3/8)/(3/8 x 1/2)^2/w.
    """
    points = 30 * 4000
    turn = np.arange(points) / points
    share = 1.0 / 30.0
    burst = np.where(turn < share, np.sin(np.pi * turn / share) ** 2, 0.0)
    signal = burst * np.cos(2.0 * np.pi * 17017 * turn + 0.4)
    moments = [np.mean(signal**power) for power in (2, 4, 6)]
    assert moments[1] / moments[0] ** 2 == pytest.approx(35.0 / (12.0 * share), rel=1e-3)
    found = pt.condition_indicators(signal, 59999)  # takes out orders 1, 2 and those at the end
    assert found.fm4 == pytest.approx(87.5, rel=2e-3)
    assert found.m6a == pytest.approx(9625.0, rel=5e-3)


def noise(seed):
    return np.random.default_rng(seed).normal(size=len(TURN))


def test_na4_reacts_to_a_jump_and_forgets_it_and_na4_star_does_not():
    """Of equal records of kurtosis k, doubled from the 11th on.

    The k-th has 16 k over the squared mean of ten ones and k - 10 fours.
    """
    residual = pt.gear_signals(CARRIER + 0.1 * noise(1), Z).residual
    k = np.mean(residual**4) / np.mean(residual**2) ** 2

    def at(number):
        series = [residual if one < 10 else 2.0 * residual for one in range(number)]
        return of(series[-1], earlier=series[:-1], healthy=series[:10])

    for number, known in ((11, 29.545), (20, 7.657), (50, 4.140), (100, 3.496)):
        found = at(number)
        mean = (10.0 + 4.0 * (number - 10)) / number
        assert found.na4 == exactly(16.0 * k / mean**2)
        assert found.na4 == pytest.approx(known * k / 2.991, rel=3e-4)
        assert found.na4_star == exactly(16.0 * k)
    tenth = of(2.0 * residual, earlier=[residual] * 9)
    assert tenth.na4 == exactly(16.0 * k / 1.69)


def test_na4_keeps_first_sidebands_and_fm4_does_not():
    found = of(modulated(0.2))
    assert found.na4 == exactly(2.25)
    assert math.isnan(found.fm4)


def test_nb4_grows_with_the_modulation_and_kurtosis_does_not():
    sound = [modulated(0.1)] * 9
    found = of(modulated(0.2), earlier=sound)
    assert found.nb4 == exactly(16.0 * 1.5 / 1.69)


def test_the_energy_operator_of_two_tones_has_its_beat():
    """a1^2 sin^2 w1 + a2^2 sin^2 w2, and A at w1 - w2: kurtosis 1.5 where the sum is small."""
    n = 4096
    k, (one, two) = np.arange(n), (2.0 * np.pi * 30 / n, 2.0 * np.pi * 33 / n)
    signal = np.cos(one * k) + 0.3 * np.cos(two * k)
    beat = 0.3 * (1.0 - math.cos(one + two))
    other = 0.3 * (1.0 - math.cos(one - two))
    energy = signal**2 - np.roll(signal, 1) * np.roll(signal, -1)
    assert energy.mean() == exactly(math.sin(one) ** 2 + 0.09 * math.sin(two) ** 2)
    spectrum = 2.0 * np.abs(np.fft.rfft(energy)) / n
    assert spectrum[3] == pytest.approx(beat, rel=1e-6)
    assert spectrum[63] == pytest.approx(other, rel=1e-6)
    assert other < 0.01 * beat
    assert of(signal).energy_operator == pytest.approx(1.5, rel=0.01)


def test_what_is_lost_in_the_steps_of_a_sensor_is_undefined():
    average = CARRIER + 1e-3 * np.cos(7.0 * TURN)
    assert of(average).fm4 == exactly(1.5)
    assert math.isnan(of(average, resolution=1e-3).fm4)
    assert math.isnan(of(np.zeros(2000)).crest_factor)


def test_too_few_points_for_the_sidebands_are_a_reason():
    found = pt.condition_indicators(np.cos(2.0 * np.pi * 30 * np.arange(64) / 64), Z)
    assert "too few teeth or points" in found.reasons["sideband_energy_ratio"]
    assert "three points for each tooth" in found.reasons["nb4"]
    with pytest.raises(ValueError, match="40 points for 30 teeth: must be at least two a tooth"):
        pt.gear_signals(np.ones(40), Z)
    with pytest.raises(ValueError, match=r"earlier: shape \(2, 9\): must be \(records, 1920\)"):
        of(CARRIER, earlier=np.ones((2, 9)))


def test_the_parts_of_an_average_have_the_orders_that_are_listed():
    average = 3.0 + sum(np.cos(order * TURN) for order in (1, 2, 5, 28, 29, 30, 31, 60, 61))
    found = pt.gear_signals(average, Z)
    assert found.difference == pytest.approx(np.cos(5 * TURN) + np.cos(28 * TURN))
    kept = sum(np.cos(order * TURN) for order in (5, 28, 29, 31, 61))
    assert found.residual == pytest.approx(kept)
    assert found.regular + found.difference == pytest.approx(found.signal)
    assert found.signal == pytest.approx(average - 3.0)
    assert {1, 2, 29, 30, 31, 59, 60, 61} <= set(found.regular_orders)
    assert set(found.removed_from_residual) == {1, 2, *range(30, 961, 30)}


def test_meshes_of_several_gears_on_a_shaft_are_all_regular():
    average = CARRIER + np.cos(47 * TURN) + 0.1 * np.cos(11 * TURN)
    found = pt.gear_signals(average, (30, 47))
    assert found.difference == pytest.approx(0.1 * np.cos(11 * TURN))


def test_the_mesh_band_has_the_amplitude_and_the_phase_of_the_modulation():
    phase = 0.2 * np.sin(3.0 * TURN)
    average = (1.0 + 0.3 * np.cos(2.0 * TURN)) * np.cos(Z * TURN + phase) + np.cos(2 * Z * TURN)
    found = mesh_band(average, Z)
    assert found.amplitude == pytest.approx(1.0 + 0.3 * np.cos(2.0 * TURN), abs=1e-6)
    assert found.phase == pytest.approx(phase, abs=1e-6)
    assert found.orders == (16, 44)
    assert np.isnan(mesh_band(np.cos(TURN), Z).phase).all()  # no line, whose phase could be known
    with pytest.raises(ValueError, match="half_width = 15"):
        mesh_band(average, Z, half_width=15)
