"""Scuffing temperature against the printed figure of a commercial program."""

import pytest

from planetary_twin_py.durability.scuffing import margin, scuffing_temperature


def test_limit_and_margin_are_those_that_a_commercial_program_prints():
    # stage 1 of the NREL 5 MW reference gearbox, KISSsoft 03/2017: stage 14, 30.09 mPa s (80 degC),
    # scuffing temperature 451.98 degC, contact temperature 169.50 degC, margin 4.156
    limit = scuffing_temperature(14, 30.09e-3)
    assert limit - 273.15 == pytest.approx(451.98, abs=0.02)
    assert margin(limit, 273.15 + 169.50, 273.15 + 80.0) == pytest.approx(4.156, abs=1e-3)
