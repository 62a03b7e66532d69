"""Figures in units of engineering practice have the value of the quantity in SI."""

import math

import pytest

from planetary_twin_py.units.conversion import to_si
from planetary_twin_py.units.engineering import figure


@pytest.mark.parametrize(
    "value, unit, shown",
    [
        (9.323e5, "N", "932.3 kN"),
        (-7424.0, "N", "-7424 N"),
        (4.18e6, "N m", "4180 kN m"),
        (45794.3, "W", "45.79 kW"),
        (2.15e9, "N/m", "2150 N/um"),
        (9.357e8, "Pa", "935.7 MPa"),
        (math.radians(20.0), "rad", "20 deg"),
        (-6.163e-4, "m", "-0.6163 mm"),
        (6.787e-7, "m", "0.6787 um"),
        (19.9651, "Hz", "19.97 Hz"),
    ],
)
def test_a_figure_has_the_unit_of_practice_and_the_value(value, unit, shown):
    assert figure(value, unit) == shown
    assert to_si(shown, unit) == pytest.approx(value, rel=1e-3)
