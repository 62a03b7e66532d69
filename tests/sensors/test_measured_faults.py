"""What an accelerometer on the ring receives of a crack, against the rule of lines."""

from fractions import Fraction

import numpy as np
import pytest
from analysis.gear_sets import gear_set

import planetary_twin_py as pt

SPEED = 200.0  # [rpm] of the sun, so slow that inertia hardly counts
CARRIER = SPEED / 60.0 * 7.0 / 40.0  # turns per second
PER_TURN = 4095  # samples of the sensor in a turn of the carrier


def measured(gear, turns):
    """Amplitudes by order in whole turns of the carrier that bring the same teeth together."""
    crack = {"kind": "crack", "gear": gear, "tooth": 0, "stiffness_loss": 0.1}
    scene = gear_set(
        (21, 39, 99), faults=[crack], input_speed=pt.rpm(SPEED),
        **{"mesh.damping": {"law": "viscous", "damping_ratio": 0.05}},
    )  # fmt: skip
    rate = PER_TURN * CARRIER
    sensor = pt.Accelerometer(rate=rate, noise=0.0, resonance=None)
    run = pt.simulate(scene, (turns + 0.3) / CARRIER, 8 * rate, settling=1.0 / CARRIER)
    signal = pt.measure_vibration(scene, run, sensor).values[: turns * PER_TURN]
    assert len(signal) == turns * PER_TURN
    amplitude = np.abs(np.fft.rfft(signal))
    return lambda order: float(amplitude[int(turns * Fraction(order))])


@pytest.mark.slow
def test_a_cracked_sun_is_measured_at_the_lines_of_the_passing_planets():
    """Window cos^8, W_1 : W_2 : W_4 = 56 : 28 : 1; f_m + f_s - f_c is forbidden."""
    at = measured("sun", 7)
    first, second, far = Fraction(733, 7), Fraction(712, 7), Fraction(754, 7)
    assert at(second) / at(first) == pytest.approx(28 / 56, rel=0.01)
    assert at(far) / at(first) == pytest.approx(1 / 56, rel=0.05)
    assert at(Fraction(752, 7)) / at(Fraction(773, 7)) == pytest.approx(2.0, rel=0.01)
    assert at(Fraction(726, 7)) < 0.003 * at(first)


@pytest.mark.exhaustive
def test_a_cracked_planet_is_measured_without_the_lines_that_the_others_carry():
    """n = 28: lines at 28 x 33/13 +- 1 and +- 2 as W_1 : W_2, nearly none at 0 and +- 3."""
    at = measured("planet", 13)
    middle = 28 * Fraction(33, 13)
    for side in (-1, 1):
        assert at(middle + side) / at(middle + 2 * side) == pytest.approx(2.0, rel=0.01)
        assert at(middle + 3 * side) < 0.03 * at(middle + side)
    assert at(middle) < 0.03 * at(middle + 1)


@pytest.mark.exhaustive
def test_a_cracked_ring_is_measured_at_multiples_of_the_planets_only():
    at = measured("ring", 2)
    halves = range(
        20, 600
    )  # the sensor subtracts means over 2.3 turns: low orders are what is left
    others = max(at(Fraction(half, 2)) for half in halves if half % 6)
    own = [at(Fraction(half, 2)) for half in halves if not half % 6 and 40 < abs(half - 198) < 100]
    assert others < 0.1 * min(own)
