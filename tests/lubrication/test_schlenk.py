"""Schlenk's mean coefficient against values that a gear program prints with its data."""

import math

import pytest
from planetary_twin_core_parts import schlenk_coefficient

from planetary_twin_py.lubrication.schlenk import log_schlenk_factor

# FZG gears C in the reports of GEARpie (C. M. C. G. Fernandes, MIT licence): face width [mm], base
# circle load [N], pitch line speed [m/s], viscosity [mPa s], X_L of its oil, and what it prints.
REPORTS = [(40.0, 6370.7, 6.90, 49.85, 0.65, 0.0256), (14.0, 5912.1, 5.75, 13.28, 0.846, 0.0449)]
ROUGHNESS = (0.4 + 0.31) / 2  # Ra, mean of both flanks [um]
PITCH, BASE = (36.6, 54.9), (33.829, 50.743)  # radii [mm]


@pytest.mark.parametrize("width, load, speed, viscosity, oil, printed", REPORTS)
def test_coefficient_of_the_fzg_gears_is_the_printed_one(
    width, load, speed, viscosity, oil, printed
):
    first, second = (math.sqrt(p * p - b * b) for p, b in zip(PITCH, BASE, strict=True))
    radius, sine = first * second / (first + second), first / PITCH[0]
    # In a mesh of 1.46 pairs of spur teeth the shortest line of contact is one face width.
    factor = log_schlenk_factor(
        1e-3 * width, 1e-3 * viscosity, 1e-6 * math.sqrt(math.pi) * ROUGHNESS, oil
    )
    logs = (math.log(load), math.log(speed * sine), math.log(1e-3 * radius))
    assert schlenk_coefficient(factor, *logs) == pytest.approx(printed, abs=5.1e-5)


def test_exponents_are_the_printed_ones():
    def mu(width=0.02, viscosity=0.08, roughness=2e-7, load=1e3, speed=1.0, radius=1e-2):
        factor = log_schlenk_factor(width, viscosity, roughness, 1.0)
        return schlenk_coefficient(factor, *map(math.log, (load, speed, radius)))

    for name, exponent in (
        ("load", 0.2), ("width", -0.2), ("speed", -0.2), ("radius", -0.2),
        ("viscosity", -0.05), ("roughness", 0.25),
    ):  # fmt: skip
        default = mu.__defaults__[mu.__code__.co_varnames.index(name)]
        assert mu(**{name: 2 * default}) / mu() == pytest.approx(2**exponent, rel=1e-9)
