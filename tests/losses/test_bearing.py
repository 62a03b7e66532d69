"""Palmgren's torques against his formulas evaluated in mm, mm^2/s and rpm."""

import math

import pytest

from planetary_twin_py.losses.bearing import bearing_torque


@pytest.mark.parametrize(
    "f0, f1, diameter, viscosity, rpm, load, expected",
    [
        # 1e-7 * 2 * (100 * 1000)^(2/3) * 50^3 = 53.86 N mm; 5e-4 * 1000 * 25 = 12.5 N mm
        (2.0, 5e-4, 50.0, 100.0, 1000.0, 1000.0, 53.86e-3 + 12.5e-3),
        # nu n = 1500 < 2000: 160e-7 * 8 * 10^3 = 0.128 N mm
        (8.0, 0.0, 10.0, 100.0, 15.0, 500.0, 0.128e-3),
        (0.0, 1e-3, 20.0, 100.0, 1000.0, 3500.0, 35e-3),
    ],
)
def test_torque_is_that_of_the_formula(f0, f1, diameter, viscosity, rpm, load, expected):
    speed, dm = rpm * math.pi / 30, diameter * 1e-3
    found = bearing_torque(f0 * dm**3, 0.5 * f1 * dm, viscosity * 1e-6, speed, load)
    assert found == pytest.approx(expected, rel=1e-2)  # 160 stands for 1e-7 2000^(2/3) = 158.7e-7


def test_both_branches_meet_at_2000_to_the_accuracy_of_the_printed_coefficients():
    """1e-7 * 2000^(2/3) is 158.7e-7, printed as 160e-7; the first is used for both."""
    slow = bearing_torque(1.0, 0.0, 1e-4, 19.999 * math.pi / 30, 0.0)
    fast = bearing_torque(1.0, 0.0, 1e-4, 20.001 * math.pi / 30, 0.0)
    assert slow == pytest.approx(fast, rel=1e-3)
    assert slow == pytest.approx(16.0, rel=0.01)
