"""Estimates are printed with the digits that their intervals support."""

import math

import pytest

from planetary_twin_py.text.intervals import interval_text


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
