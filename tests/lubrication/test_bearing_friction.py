"""Palmgren's torques against his formulas evaluated in mm, mm^2/s and rpm."""

import math

import pytest
from planetary_twin_core_parts import bearing_torque

import planetary_twin_py as pt
from planetary_twin_py.model.gearbox import Gearbox


@pytest.mark.parametrize(
    "f0, f1, diameter, viscosity, rpm, load, expected",
    [
        # 1e-7 * 2 * (100 * 1000)^(2/3) * 50^3 = 53.86 N mm; 5e-4 * 1000 * 50 = 25 N mm
        (2.0, 5e-4, 50.0, 100.0, 1000.0, 1000.0, 53.86e-3 + 25e-3),
        # nu n = 1500 < 2000: 160e-7 * 8 * 10^3 = 0.128 N mm
        (8.0, 0.0, 10.0, 100.0, 15.0, 500.0, 0.128e-3),
        (0.0, 1e-3, 20.0, 100.0, 1000.0, 3500.0, 70e-3),
    ],
)
def test_torque_is_that_of_the_formula(f0, f1, diameter, viscosity, rpm, load, expected):
    speed, dm = rpm * math.pi / 30, diameter * 1e-3
    found = bearing_torque(f0 * dm**3, f1 * dm, viscosity * 1e-6, speed, load)
    assert found == pytest.approx(expected, rel=1e-2)  # 160 stands for 1e-7 2000^(2/3) = 158.7e-7


def test_a_roller_bearing_has_its_catalogued_friction():
    """Makers give 0.0011 for caged cylindrical rollers, at the bore, M = mu F d/2, under a tenth of
    the load rating: of an NU 208, 40 by 80 mm, 62 kN. Palmgren's f1 of its series is 3e-4, f0 2 and
    more. The oil, 20 mm^2/s at 1000 rpm, counts for a quarter of the torque."""
    bearing = {"mean_diameter": "60 mm", "f0": 2.0, "f1": 3e-4}
    train = Gearbox(pt.load_scene("paper").replace(losses={"planet_bearing": bearing})).train
    load, speed = 6200.0, pt.rpm(1000)
    found = bearing_torque(
        train.joints.no_load_factor[0], train.joints.load_factor[0], 20e-6, speed, load
    )
    assert found == pytest.approx(0.0011 * load * 0.020, rel=0.1)


def test_branches_meet_at_2000_within_the_printed_digits():
    """1e-7 * 2000^(2/3) is 158.7e-7, printed as 160e-7; the first is used for both."""
    slow = bearing_torque(1.0, 0.0, 1e-4, 19.999 * math.pi / 30, 0.0)
    fast = bearing_torque(1.0, 0.0, 1e-4, 20.001 * math.pi / 30, 0.0)
    assert slow == pytest.approx(fast, rel=1e-3)
    assert slow == pytest.approx(16.0, rel=0.01)
