"""Viscous friction against eqs. (12), (13) evaluated at the pitch points."""

import math

import pytest
from lubrication.pitch_point import CASES, LOAD, MODULUS, VISCOSITY, film, oil_of, pitch_point
from planetary_twin_core_parts import sliding_sense, viscous_friction

from planetary_twin_py.scene import load_scene

TRACTION = oil_of(load_scene("paper")).traction


def friction(mesh, rpm, load=LOAD, traction=TRACTION):
    point = pitch_point(mesh, rpm)
    area = point.area * math.sqrt(load / LOAD)
    h = film("salagianni", mesh, rpm, load)
    log_heat = 0.5 * math.log(point.radius * load / (area * point.speed))
    return viscous_friction(traction, load, area, math.log(h), log_heat)


def test_coefficients_at_the_pitch_points():
    coefficients = [friction(mesh, rpm) / LOAD for mesh, rpm in CASES]
    expected = [0.04251, 0.04179, 0.04123, 0.04105, 0.03988, 0.03897]
    assert coefficients == pytest.approx(expected, abs=6e-6)


@pytest.mark.parametrize("mesh, rpm", CASES)
def test_friction_is_equation_12_with_temperature_coefficient(mesh, rpm):
    point, h = pitch_point(mesh, rpm), film("salagianni", mesh, rpm)
    p = LOAD / point.area
    zeta = 4 / math.pi * 0.137 / (h / point.radius)
    zeta *= math.sqrt(p / (MODULUS * point.radius * 46 * 7800 * 470 * point.speed))
    root = math.sqrt(2 * 0.137 * VISCOSITY / 0.04 / (1 + 9.6 * zeta))
    mu = 0.87 * 2.1e-8 * 2.3e6 + 1.74 * 2.3e6 / p * math.log(1.2 / (2.3e6 * h) * root)
    assert friction(mesh, rpm) == pytest.approx(mu * LOAD, rel=1e-9)


def test_friction_is_zero_under_a_load_too_light_for_the_law():
    assert friction("pr", 1000, LOAD / 1000) == 0.0


@pytest.mark.parametrize("film, heating", [(0.5e-6, 0.3), (2e-6, 1.0)])
def test_friction_acts_above_the_pressure_that_the_film_asks_for(film, heating):
    """2/alpha ln(h sqrt(1 + 9.6 Theta)/h0), from (12) solved for the pressure."""
    thinnest = 1.2 / 2.3e6 * math.sqrt(2 * 0.137 * VISCOSITY / 0.04)
    pressure = 2 / 2.1e-8 * math.log(film * math.sqrt(1 + 9.6 * heating) / thinnest)
    assert pressure > 0.0
    area, log_heat = 1e-6, math.log(9.6 * heating) + math.log(film) - TRACTION.log_heating
    below, above = (
        viscous_friction(TRACTION, share * pressure * area, area, math.log(film), log_heat)
        for share in (1 - 1e-6, 1 + 1e-6)
    )
    assert below == 0.0 < above


def test_sense_of_sliding_is_odd_tanh_of_the_slide_to_roll_ratio():
    for ratio in (0.0, 1e-4, 0.015, 0.1, 3.0):
        expected = math.tanh(ratio / 0.015)
        assert sliding_sense(ratio / 0.015) == pytest.approx(expected, abs=1e-11)
        assert sliding_sense(-ratio / 0.015) == pytest.approx(-expected, abs=1e-11)


PRINTED = load_scene("paper").replace(**{"lubrication.traction": "printed"})


@pytest.mark.parametrize(
    "conductivity, expected",
    [
        (2000.0, [0.03708, 0.03683, 0.03668, 0.03287, 0.03248, 0.03225]),
        (0.137, [0.0366, 0.0359, 0.0353, 0.0321, 0.0309, 0.0300]),
    ],
)
def test_printed_coefficients_with_both_conductivities(conductivity, expected):
    scene = PRINTED.replace(**{"lubrication.oil_conductivity": conductivity})
    traction = oil_of(scene).traction
    found = [friction(mesh, rpm, traction=traction) / LOAD for mesh, rpm in CASES]
    assert found == pytest.approx(expected, abs=6e-5)


def test_printed_form_has_no_floor():
    traction = oil_of(PRINTED.replace(**{"lubrication.oil_conductivity": 2000.0})).traction
    assert friction("sp", 1000, LOAD * 0.50 / 63, traction) < 0.0
    assert friction("sp", 1000, LOAD * 0.58 / 63, traction) > 0.0
