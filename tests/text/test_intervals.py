"""Estimates are printed with the digits that their intervals support."""

import math

import pytest

from planetary_twin_py.text.intervals import interval_text, plus_minus


@pytest.mark.parametrize(
    ("value", "low", "high", "expected"),
    [
        (0.780982, 0.7252, 0.836764, ("0.781", "0.725 to 0.837")),
        (60.0352, 59.9067, 60.1637, ("60.04", "59.91 to 60.16")),
        (2e-7, 1.99997e-7, 2.00002e-7, ("2e-07", "1.99997e-07 to 2.00002e-07")),
        (1.0, 0.855308, 1.0, ("1", "0.855 to 1")),
        (12345.6, 11000.0, 13700.0, ("12300", "11000 to 13700")),
        (-0.5, -0.5, -0.5, ("-0.5", "-0.5 to -0.5")),
        (3.0, -math.inf, math.inf, ("3", "-inf to inf")),
        (3.0, math.nan, math.nan, ("3", "-")),
    ],
)
def test_two_digits_of_half_the_width_are_kept(value, low, high, expected):
    assert interval_text(value, low, high) == expected


@pytest.mark.parametrize(
    ("value", "half", "expected"),
    [
        (354.7, 19.2, "+355 +- 19"),
        (0.976, 0.29, "+0.98 +- 0.29"),
        (-350.2, 187.0, "-350 +- 190"),
        (1234567.0, 3456.0, "+1234600 +- 3500"),
        (0.5, 0.0, "+0.5 +- 0"),
    ],
)
def test_an_estimate_and_its_uncertainty_have_the_same_places(value, half, expected):
    assert plus_minus(value, half, "+") == expected
    assert plus_minus(value, half) == expected.removeprefix("+")
