"""Walther's equation against data sheets and against its own definition."""

import math

import pytest

from planetary_twin_py.lubrication.viscosity import viscosity_at, walther_slope

DEGREES = 273.15
VG = {  # mm^2/s at 40 and 100 deg C; thermal coefficient at 70 deg C [1/K]
    320: (320.0, 24.0, 0.0419),
    460: (460.0, 30.5, 0.0439),
}
OILS = pytest.mark.parametrize("grade", VG)


def slope(grade):
    cold, hot, _ = VG[grade]
    return walther_slope((40 + DEGREES, cold * 1e-6), (100 + DEGREES, hot * 1e-6))


@OILS
def test_passes_through_both_points_of_the_data_sheet(grade):
    cold, hot, _ = VG[grade]
    at = (100 + DEGREES, hot * 1e-6 * 890.0)
    assert viscosity_at(40 + DEGREES, at, slope(grade), 890.0) == pytest.approx(cold * 890e-6)


@OILS
def test_thermal_coefficient_at_70_degrees(grade):
    cold, _, coefficient = VG[grade]
    at = (40 + DEGREES, cold * 1e-6 * 890.0)
    warm, cool = (viscosity_at(t + DEGREES, at, slope(grade), 890.0) for t in (70.5, 69.5))
    assert math.log(cool / warm) == pytest.approx(coefficient, abs=1e-4)
