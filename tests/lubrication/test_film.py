"""Film laws against the printed eq. (15), against their scaling, and against computed films."""

import math

import pytest
from lubrication.pitch_point import (
    CASES,
    FACE_WIDTH,
    LOAD,
    MODULUS,
    PRESSURE_VISCOSITY,
    VISCOSITY,
    film,
    oil_of,
    pitch_point,
)
from planetary_twin_core_parts import THINNEST_FILM

from planetary_twin_py._core import tooth_contact
from planetary_twin_py.scene import load_scene

FILMS = {  # [um] at the pitch point
    "salagianni": (0.160, 0.260, 0.345, 0.230, 0.374, 0.497),
    "dowson_higginson": (0.125, 0.204, 0.271, 0.181, 0.293, 0.390),
    "dowson_toyoda": (0.168, 0.272, 0.359, 0.238, 0.384, 0.509),
}


@pytest.mark.parametrize("mesh, rpm", CASES)
def test_law_of_the_paper_is_its_printed_equation(mesh, rpm):
    r, v = pitch_point(mesh, rpm)
    alpha = PRESSURE_VISCOSITY
    pressure = LOAD / (2 * FACE_WIDTH * pitch_point(mesh, rpm).half_width)
    printed = (
        2.5 * r * (v * VISCOSITY * alpha / r) ** 0.7 * (alpha * MODULUS) ** 0.1
        / (alpha * pressure) ** 0.26
    )  # fmt: skip
    assert film("salagianni", mesh, rpm) == pytest.approx(printed, rel=1e-9)


@pytest.mark.parametrize("law", FILMS)
def test_films_at_the_pitch_point(law):
    films = [film(law, mesh, rpm) * 1e6 for mesh, rpm in CASES]
    assert films == pytest.approx(FILMS[law], abs=6e-4)


@pytest.mark.parametrize("law", ["salagianni", "dowson_higginson"])
def test_film_grows_with_speed_and_radius_and_thins_with_load(law):
    thinnest = film(law, "sp", 1000)
    assert film(law, "sp", 2000) / thinnest == pytest.approx(2**0.7)
    assert film(law, "sp", 3000) / thinnest == pytest.approx(3**0.7)
    assert film(law, "pr", 1000) / thinnest == pytest.approx((7 / 3) ** 0.43)
    assert film(law, "sp", 1000, 3 * LOAD) / thinnest == pytest.approx(3**-0.13)


@pytest.mark.parametrize("speed", [0.0, 1e-9, 1e-6])
def test_film_of_a_tooth_pair_never_vanishes(speed):
    oil = oil_of(load_scene("paper"))
    log_film = tooth_contact(oil, (0.01, 0.01, 1.0, speed, -speed, LOAD))[3]
    assert log_film == math.log(THINNEST_FILM)
