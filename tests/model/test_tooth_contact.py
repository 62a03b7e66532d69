"""Friction of a tooth pair stays in its bounds anywhere in the declared ranges."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lubrication.friction_laws import FRICTION_LAWS
from planetary_twin_core_parts import lambda_ratio_of

from planetary_twin_py._core import tooth_contact
from planetary_twin_py.model.oil import build_oil
from planetary_twin_py.scene import friction_table, load_scene

TABLE = friction_table(
    lambda pressure, sliding_speed: 0.02 + 1e-12 * pressure + 0.01 * sliding_speed,
    pressure=(1e6, 1e8, 1e10),
    sliding_speed=(0.01, 0.1, 1.0),
)
PAPER = load_scene("paper").replace(**{"lubrication.friction_table": TABLE})
LAWS = st.fixed_dictionaries(
    {
        "lubrication.film": st.sampled_from(["dowson_higginson", "dowson_toyoda", "salagianni"]),
        "lubrication.lambda_ratio": st.sampled_from(["prescribed", "computed"]),
        "lubrication.asperities": st.sampled_from(["exact", "printed"]),
        "lubrication.boundary": st.sampled_from(["greenwood_tripp", "load_sharing"]),
        "lubrication.traction": st.sampled_from(FRICTION_LAWS),
        "lubrication.rolling": st.sampled_from(["none", "goksem_hargreaves"]),
        "oil_temperature": st.floats(233.15, 433.15),
        "lambda_ratio": st.floats(0.0, 10.0),
        "lubrication.viscosity": st.floats(1e-3, 10.0),
        "lubrication.composite_roughness": st.floats(1e-12, 1e-4),
    }
)
PAIR = st.tuples(
    st.floats(1e-4, 1.0),
    st.floats(1.01, 100.0),  # of the second radius of curvature over the first
    st.sampled_from([1.0, -1.0]),
    st.floats(-1e5, 1e5),
    st.floats(-1e5, 1e5),
    st.floats(0.0, 1e7),
)


@settings(max_examples=300, deadline=None, derandomize=True)
@given(laws=LAWS, pair=PAIR)
def test_finite_dissipative_and_never_negative_unless_printed_so(laws, pair):
    scene = PAPER.replace(**laws)
    oil = build_oil(scene, scene.operating_point)
    rho1, factor, external, *rest = pair
    signed, boundary, viscous, log_film, sliding, slope, rolling, taken = tooth_contact(
        oil, (rho1, factor * rho1, external, *rest)
    )
    ratio = lambda_ratio_of(oil, log_film)
    for value in (signed, boundary, viscous, log_film, ratio, sliding, slope, rolling, taken):
        assert math.isfinite(value)
    assert math.exp(log_film) > 0.0 and ratio >= 0.0
    u1, u2 = rho1 * rest[0], -external * factor * rho1 * rest[1]
    assert rolling * (u1 + u2) >= 0.0 and taken >= 0.0
    if scene.lubrication.traction != "printed":
        assert viscous >= 0.0
        if scene.lubrication.asperities == "exact" or scene.lubrication.boundary == "load_sharing":
            assert boundary >= 0.0
            assert signed * sliding >= 0.0 and slope >= 0.0


FILM_ALONE = PAPER.replace(
    **{
        "lubrication.traction": "eyring",
        "lubrication.boundary": "load_sharing",
        "lubrication.lambda_ratio": "computed",
        "lubrication.composite_roughness": 1e-9,
    }
)
MIXED = FILM_ALONE.replace(**{"lubrication.composite_roughness": 1e-6})
RHO = 0.01  # radius of curvature of both flanks [m]


def sheared(scene, load, slide_to_roll, speed=1.0):
    """Signed friction [N], film [m], sliding speed [m/s] and slope [N s/m] at a mean speed."""
    oil = build_oil(scene, scene.operating_point)
    turns = (speed * (1 + slide_to_roll / 2) / RHO, -speed * (1 - slide_to_roll / 2) / RHO)
    signed, _, _, log_film, sliding, slope, _, _ = tooth_contact(oil, (RHO, RHO, 1.0, *turns, load))
    return signed, math.exp(log_film), sliding, slope


@pytest.mark.parametrize("slide_to_roll", [-0.1, -1e-4, 1e-6, 1e-3, 0.1])
def test_a_light_load_shears_a_newtonian_film_down_to_no_sliding(slide_to_roll):
    """f = eta Vs/h A, A = 2 b L with Hertz's b; the sense of sliding takes nothing from it."""
    load, modulus = 1e-3, 206e9 / (1 - 0.3**2)
    signed, film, sliding, slope = sheared(FILM_ALONE, load, slide_to_roll)
    width = math.sqrt(8 * load * (RHO / 2) / (math.pi * 0.02 * modulus))
    newtonian = 0.08 / film * 2 * width * 0.02
    # 2e-3 is alpha times the pressure; loads fade out below a millionth of a newton.
    assert signed == pytest.approx(newtonian * sliding, rel=1e-2)
    assert slope == pytest.approx(newtonian, rel=1e-2)


@pytest.mark.parametrize("load", [1.0, 100.0, 1e4])
@pytest.mark.parametrize("scene", [FILM_ALONE, MIXED], ids=["film", "mixed"])
def test_friction_is_odd_and_smooth_through_no_sliding(scene, load):
    ratios = np.linspace(-0.2, 0.2, 4001)
    found = np.array([sheared(scene, load, ratio) for ratio in ratios])
    friction, slope = found[:, 0], found[:, 3]
    assert friction == pytest.approx(-friction[::-1], rel=1e-6, abs=1e-9 * load)
    assert friction[2000] == pytest.approx(0.0, abs=1e-12 * load)
    # No step of 1e-4 of slide-to-roll is more than its share of an elastic line over 0.015.
    least = 0.11 * load * 1e-4 / 0.015
    assert np.abs(np.diff(friction)).max() < 1.1 * least
    assert slope.min() >= 0.0


@pytest.mark.parametrize("slide_to_roll", [0.0, 1e-8, 1e-5, 1e-3, 0.01, 0.1])
@pytest.mark.parametrize("load", [1e-3, 1.0, 100.0, 2e3])
@pytest.mark.parametrize("scene", [FILM_ALONE, MIXED], ids=["film", "mixed"])
def test_slope_is_the_derivative_of_the_friction_in_a_cool_film(scene, load, slide_to_roll):
    cool = scene.replace(**{"lubrication.temperature_viscosity": 1e-12})
    step = max(1e-3 * slide_to_roll, 1e-9)
    (below, _, slow, _), (above, _, fast, _) = (
        sheared(cool, load, slide_to_roll + s) for s in (-step, step)
    )
    slope = sheared(cool, load, slide_to_roll)[3]
    assert slope == pytest.approx((above - below) / (fast - slow), rel=0.01, abs=1e-4 * load)


def test_schlenks_coefficient_is_all_of_the_friction():
    scene = PAPER.replace(**{"lubrication.traction": "schlenk"})
    signed, *_ = sheared(scene, 1000.0, 0.2)
    # 0.048 (50 N/mm / (2 m/s 5 mm))^0.2 80^-0.05 0.1128^0.25
    expected = 0.048 * (50 / 10) ** 0.2 * 80**-0.05 * (0.2 / math.sqrt(math.pi)) ** 0.25
    assert signed == pytest.approx(1000.0 * expected, rel=1e-8)
