"""What an accelerometer on the ring hears of a crack, against the rule of lines."""

from fractions import Fraction

import numpy as np
import pytest
from analysis.gear_sets import gear_set

import planetary_twin_py as pt

SPEED = 200.0  # [rpm] of the sun, so slow that inertia hardly counts
CARRIER = SPEED / 60.0 * 7.0 / 40.0  # turns per second
PER_TURN = 4095  # samples of the sensor in a turn of the carrier


@pytest.mark.slow
def test_a_cracked_sun_is_heard_at_the_lines_of_the_passing_planets():
    """21/39/99: 104.7143 : 101.7143 : 107.7143 = 56 : 28 : 1, times the squares of their orders.

    The window cos^8 has W_1 : W_2 : W_4 = 56 : 28 : 1; the sensor has the acceleration.
    """
    crack = {"kind": "crack", "gear": "sun", "tooth": 0, "stiffness_loss": 0.1}
    scene = gear_set(
        (21, 39, 99), faults=[crack], input_speed=pt.rpm(SPEED),
        **{"mesh.damping": {"law": "viscous", "damping_ratio": 0.05}},
    )  # fmt: skip
    rate = PER_TURN * CARRIER
    sensor = pt.Accelerometer(rate=rate, noise=0.0, resonance=None)
    run = pt.simulate(scene, 7.3 / CARRIER, 8 * rate, settling=1.0 / CARRIER)
    heard = pt.measure_vibration(scene, run, sensor)
    signal = heard.values[: 7 * PER_TURN]
    assert len(signal) == 7 * PER_TURN
    amplitude = np.abs(np.fft.rfft(signal))

    def at(order):
        return amplitude[int(7 * Fraction(order))]

    first, second, far = Fraction(733, 7), Fraction(712, 7), Fraction(754, 7)
    print(at(first), at(second), at(far), at(Fraction(726, 7)))
    assert at(second) / at(first) == pytest.approx(28 / 56, rel=0.01)
    assert at(far) / at(first) == pytest.approx(1 / 56, rel=0.05)
    assert at(Fraction(726, 7)) < 0.003 * at(first)  # f_m + f_s - f_c
