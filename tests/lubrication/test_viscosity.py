"""Walther's equation against data sheets and against its own definition."""

import math

import pytest

from planetary_twin_py.lubrication.viscosity import viscosity_at, walther_slope
from planetary_twin_py.scene import load_scene

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


def test_oil_of_the_paper_is_a_vg_460():
    """0.08 Pa s at 70 deg C: VG 460 has 0.0805 Pa s there with a density of 890 kg/m^3."""
    cold, _, _ = VG[460]
    at = (40 + DEGREES, cold * 1e-6 * 890.0)
    found = viscosity_at(70 + DEGREES, at, slope(460), 890.0)
    assert found == pytest.approx(0.0805, rel=0.05)
    assert load_scene("paper").lubrication.viscosity_slope == pytest.approx(slope(460), abs=1e-4)


@pytest.mark.parametrize("steepness", [0.0, 3.3, 6.0])
@pytest.mark.parametrize("viscosity", [1e-3, 0.08, 10.0])
def test_falls_with_temperature_and_stays_positive_and_finite(viscosity, steepness):
    values = [
        viscosity_at(t, (343.15, viscosity), steepness, 890.0)
        for t in (233.15, 300.0, 343.15, 433.15)
    ]
    assert values[2] == pytest.approx(viscosity)
    assert all(0.0 < v < math.inf for v in values)
    assert values == sorted(values, reverse=True)
