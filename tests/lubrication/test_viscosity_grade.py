"""Viscosities of graded oils against ISO 3448, ASTM D2270 and data sheets."""

import pytest

from planetary_twin_py.lubrication.viscosity import viscosity_at, walther_slope
from planetary_twin_py.lubrication.viscosity_grade import (
    COLD,
    GRADES,
    HOT,
    cold_viscosity,
    hot_viscosity,
)

# ISO 3448, annex: limits [mm^2/s] at 50 deg C of oils of index 95.
AT_50 = {
    46: (27.0, 32.5), 68: (38.7, 46.6), 100: (55.3, 66.6), 150: (80.6, 97.1), 220: (115.0, 138.0),
    320: (163.0, 196.0), 460: (228.0, 274.0), 680: (326.0, 393.0), 1000: (466.0, 560.0),
}  # fmt: skip
# ASTM D2270, table of Y, L and H [mm^2/s].
SERIES = [
    (2.0, 7.994, 6.394), (5.0, 40.23, 28.49), (10.0, 147.7, 82.87), (20.0, 493.2, 229.5),
    (30.0, 1023.0, 421.7), (50.0, 2618.0, 919.6), (70.0, 4905.0, 1558.0),
]  # fmt: skip
# Grade, index and viscosity at 100 deg C [mm^2/s] of mineral and synthetic gear oils.
DATA_SHEETS = [
    (100, 97, 11.2), (150, 97, 14.7), (220, 97, 19.0), (320, 97, 24.1), (460, 96, 30.6),
    (46, 161, 8.5), (150, 166, 21.1), (220, 169, 28.5), (320, 172, 38.5), (460, 174, 50.7),
]  # fmt: skip


@pytest.mark.parametrize("grade", AT_50)
def test_viscosities_are_in_the_middle_of_the_standard_range(grade):
    cold = 1e-6 * grade
    slope = walther_slope((COLD, cold), (HOT, hot_viscosity(cold, 95.0)))
    found = viscosity_at(323.15, (COLD, 890.0 * cold), slope, 890.0) / 890.0
    low, high = AT_50[grade]
    assert 1e6 * found == pytest.approx(0.5 * (low + high), rel=0.005)


@pytest.mark.parametrize("hot, index_0, index_100", SERIES)
def test_reference_oils_are_those_of_the_standard(hot, index_0, index_100):
    assert 1e6 * cold_viscosity(1e-6 * hot, 0.0) == pytest.approx(index_0, rel=2e-3)
    assert 1e6 * cold_viscosity(1e-6 * hot, 100.0) == pytest.approx(index_100, rel=2e-3)


def test_the_example_of_the_standard_has_the_index_92():
    assert 1e6 * cold_viscosity(8.86e-6, 92.0) == pytest.approx(73.30, rel=0.005)


@pytest.mark.parametrize("grade, index, hot", DATA_SHEETS)
def test_oils_have_the_viscosity_of_their_data_sheets(grade, index, hot):
    assert 1e6 * hot_viscosity(1e-6 * grade, index) == pytest.approx(hot, rel=0.015)


@pytest.mark.parametrize("index", [0.0, 95.0, 100.0, 100.001, 250.0])
@pytest.mark.parametrize("grade", GRADES[1:])
def test_both_viscosities_fit_together(grade, index):
    hot = hot_viscosity(1e-6 * grade, index)
    assert cold_viscosity(hot, index) == pytest.approx(1e-6 * grade, rel=2e-3)


def test_an_oil_without_an_index_is_refused():
    with pytest.raises(ValueError, match="below 2 mm\\^2/s at 100 degC"):
        hot_viscosity(4e-6, 95.0)
