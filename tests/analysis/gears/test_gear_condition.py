"""The condition of a gear in a signal of known parts."""

import numpy as np
import pytest

from planetary_twin_py.analysis.gears.gear_condition import gear_condition, quantisation
from planetary_twin_py.analysis.signals.signal import Signal
from planetary_twin_py.gearset.kinematics import Teeth

TEETH = Teeth(30, 20, 70)
RATE = 20_000.0


def signal(parts, turns=24.0, noise=0.0):
    """A signal with parts over the angle of the sun relative to the carrier, 10 turns a second."""
    time = np.arange(0.0, turns / 10.0, 1.0 / RATE)
    angle = 2.0 * np.pi * 10.0 * time
    samples = parts(angle) + noise * np.random.default_rng(3).normal(size=len(time))
    return Signal(samples, time, angle, None)


def meshing(angle):
    return np.cos(30.0 * angle)


@pytest.mark.parametrize(
    ("gear", "mesh", "turns", "period"),
    [
        ("sun", "sun_planet_1", 22, 2),
        ("planet", "sun_planet_1", 33, 3),
        ("planet", "planet_ring_1", 35, 7),
        ("planet", None, 21, 21),
        ("ring", "planet_ring_2", 10, 2),
    ],
)
def test_turns_are_whole_meshing_periods(gear, mesh, turns, period):
    """In 23.9 turns of the sun: 20/10, 30/10, 70/10, both, and 20/10 turns of the gear."""
    found = gear_condition(signal(meshing, 23.9), TEETH, gear, mesh)
    assert (len(found.average.turns), found.period) == (turns, period)
    assert not any("same teeth" in line for line in found.remarks(simulated=False))


def test_a_fault_of_the_mate_vanishes_in_whole_periods():
    """A planet turns 3/2 times per turn of the sun: its order 4 is order 6 of the sun; 3 is 4.5."""
    found = gear_condition(
        signal(lambda angle: meshing(angle) + 0.3 * np.cos(4.5 * angle)), TEETH, "sun", None
    )
    assert found.difference < 2e-3
    own = gear_condition(
        signal(lambda angle: meshing(angle) + 0.3 * np.cos(4.5 * angle)), TEETH, "planet", None
    )
    assert own.difference == pytest.approx(0.3 / np.sqrt(2.0), rel=0.01)


def test_a_short_record_keeps_errors_of_the_mate_and_says_so():
    found = gear_condition(signal(meshing, 5.0), TEETH, "planet", None)
    assert any("same teeth meet after 21 turns" in line for line in found.remarks(False))


def test_the_mean_of_a_force_is_in_no_indicator():
    found = gear_condition(signal(lambda angle: 500.0 + meshing(angle)), TEETH, "sun", None)
    assert found.indicators.crest_factor == pytest.approx(np.sqrt(2.0), rel=2e-3)


def test_a_gear_outside_of_the_mesh_is_refused():
    with pytest.raises(ValueError, match="gear = 'ring': is not in the mesh 'sun_planet_1'"):
        gear_condition(signal(meshing), TEETH, "ring", "sun_planet_1")
    with pytest.raises(ValueError, match="gear = 'pinion': must be one of sun, planet, ring"):
        gear_condition(signal(meshing), TEETH, "pinion", None)


def test_the_quantisation_of_rounded_samples_is_that_of_their_steps():
    values = np.random.default_rng(4).normal(size=10_000)
    rounded = np.rint(values / 0.01) * 0.01
    assert quantisation(rounded) == pytest.approx(np.std(values - rounded), rel=0.03)
    assert quantisation(np.ones(9)) == 0.0


def test_a_difference_below_the_steps_of_the_sensor_has_no_kurtosis():
    samples = signal(lambda angle: np.rint(meshing(angle) / 0.05) * 0.05)
    found = gear_condition(samples, TEETH, "sun", None)
    assert np.isnan(found.indicators.fm4)
    assert found.indicators.reasons["fm4"].startswith("no difference signal")
