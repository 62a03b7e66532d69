"""Line contact against Johnson's p0 and against the elliptic pressure that carries the load."""

import math

import pytest

from planetary_twin_py._core import half_width
from planetary_twin_py.lubrication.hertz import contact_modulus

LOAD, RADIUS, LENGTH = 1878.8, 1.747e-3, 0.02


def test_pressure_carries_the_load_and_has_the_peak_of_johnson():
    modulus = contact_modulus(206e9, 0.3)
    peak = 2 * LOAD / (math.pi * half_width(LOAD, RADIUS, LENGTH, modulus) * LENGTH)
    assert peak == pytest.approx(math.sqrt(LOAD * modulus / (math.pi * RADIUS * LENGTH)), rel=1e-12)
    assert peak == pytest.approx(1.39e9, rel=5e-3)


def test_contact_modulus_of_steel_on_steel():
    assert contact_modulus(206e9, 0.3) == pytest.approx(113.19e9, rel=1e-4)
    assert 1 / contact_modulus(206e9, 0.3) == pytest.approx(2 * (1 - 0.3**2) / 206e9)
