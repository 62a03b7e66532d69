"""The shear-thinning film: its limits, the integral over the contact, its balance of heat."""

import math

import numpy as np
import pytest
from lubrication.pitch_point import CASES, FACE_WIDTH, LOAD, MODULUS, film, oil_of, pitch_point
from planetary_twin_core_parts import film_shear, viscous_friction
from scipy.integrate import quad
from scipy.optimize import brentq

from planetary_twin_py.scene import load_scene

VISCOSITY, ALPHA, EYRING_STRESS, LIMIT = 0.08, 2.1e-8, 2.3e6, 0.047
SCENE = load_scene("paper").replace(
    **{"lubrication.traction": "eyring", "lubrication.limiting_stress": LIMIT}
)
OIL = oil_of(SCENE)
COOL = oil_of(SCENE.replace(**{"lubrication.temperature_viscosity": 1e-12}))


def contact(load=LOAD, mesh="sp", rpm=1000):
    """Area [m^2], logarithms of film and heat as the law takes them."""
    point = pitch_point(mesh, rpm)
    area = point.area * math.sqrt(load / LOAD)
    log_heat = 0.5 * math.log(point.radius * load / (area * point.speed))
    return area, math.log(film("salagianni", mesh, rpm, load)), log_heat


def friction(speed, load=LOAD, oil=OIL, **place):
    area, log_film, log_heat = contact(load, **place)
    return film_shear(oil.shear_thinning, load, area, log_film, log_heat, speed)[0]


def over_the_contact(stress, load, area):
    """Mean of a stress that depends on the elliptic pressure, times the area [N]."""
    peak = 4.0 / math.pi * load / area
    return area * quad(lambda x: stress(peak * math.sqrt(1.0 - x * x)), 0.0, 1.0, limit=200)[0]


def test_heavy_load_and_fast_sliding_end_at_the_limiting_stress():
    load = 20 * LOAD
    assert friction(1.0, load, COOL) == pytest.approx(LIMIT * load, rel=1e-12)


def contacts_by_chance(count, oils):
    """Two points and the integral [N] of cool films, with the load [N] and the slide-to-roll."""
    random = np.random.default_rng(4)
    for _ in range(count):
        mesh, rpm = CASES[random.integers(len(CASES))]
        load, ratio = 10 ** random.uniform(-5, 1) * LOAD, 10 ** random.uniform(-8, 0.3)
        viscosity, alpha, eyring, limit = oils(random)
        oil = oil_of(
            SCENE.replace(
                **{
                    "lubrication.viscosity": viscosity, "lubrication.pressure_viscosity": alpha,
                    "lubrication.shear_stress": eyring, "lubrication.limiting_stress": limit,
                    "lubrication.temperature_viscosity": 1e-12,
                }
            )
        )  # fmt: skip
        speed = ratio * pitch_point(mesh, rpm).speed
        area, log_film, log_heat = contact(load, mesh, rpm)
        log_film += 0.67 * math.log(viscosity / VISCOSITY)  # as the film laws grow with it

        def stress(p, e=eyring, a=alpha, s=limit, time=viscosity / eyring, v=speed, h=log_film):
            return min(e * math.asinh(time * math.exp(min(a * p - h, 200.0)) * v), s * p)

        found = film_shear(oil.shear_thinning, load, area, log_film, log_heat, speed)[0]
        yield found, over_the_contact(stress, load, area), load, ratio


def of_paper(random):
    return 10 ** random.uniform(math.log10(0.005), math.log10(0.5)), ALPHA, EYRING_STRESS, LIMIT


def of_any(random):
    ranges = ((1e-8, 3e-8), (1e6, 1e7), (0.03, 0.08))
    return of_paper(random)[0], *(random.uniform(*limits) for limits in ranges)


@pytest.mark.parametrize("oils, share, coefficient", [(of_paper, 0.1, 1.1e-3), (of_any, 0.2, 0.01)])
def test_two_points_are_within_the_stated_error_of_the_integral(oils, share, coefficient):
    largest = 0.0
    for found, exact, load, ratio in contacts_by_chance(600, oils):
        error = abs(found - exact)
        largest = max(largest, error / exact)
        assert ratio < 0.01 or error < share * exact
        assert error < coefficient * load and error < 0.6 * exact
    assert largest > 2.0 * share  # so the limit of the slide-to-roll ratio is needed


@pytest.mark.parametrize("mesh, rpm", CASES)
def test_heavy_loads_are_near_the_plateau_of_evans_and_johnson(mesh, rpm):
    """Their law is a fit of its own to discs; it has no sliding speed in it."""
    area, log_film, log_heat = contact(LOAD, mesh, rpm)
    plateau = viscous_friction(OIL.traction, LOAD, area, log_film, log_heat)
    found = friction(0.2 * pitch_point(mesh, rpm).speed, mesh=mesh, rpm=rpm)
    assert found == pytest.approx(plateau, rel=0.15)


@pytest.mark.parametrize("speed", [0.01, 1.0, 5.0, 20.0])
def test_the_warm_film_is_in_balance_with_its_heat(speed):
    """sinh(s) = x exp(-beta dT), walls heated as by a band source over its transit of 2b/V."""
    point = pitch_point("sp", 1000)
    area, log_film, _ = contact()
    thickness, half = math.exp(log_film), point.half_width
    transit = 2 * half / point.speed
    # Mean over the transit of 2 q sqrt(t/pi)/e, half of the heat into each flank.
    wall = 0.5 * 4.0 / 3.0 * math.sqrt(transit / math.pi) / math.sqrt(46 * 7800 * 470)
    rise = 0.04 * speed * (thickness / (8 * 0.137) + wall)  # beta dT/tau

    def balance(p):
        x = VISCOSITY * math.exp(ALPHA * p) * speed / (thickness * EYRING_STRESS)
        s = brentq(lambda s: s - math.asinh(x * math.exp(-rise * EYRING_STRESS * s)), 0.0, 100.0)
        return min(EYRING_STRESS * s, LIMIT * p)

    expected = over_the_contact(balance, LOAD, area)
    assert friction(speed) == pytest.approx(expected, rel=0.02)
    if speed > 1.0:
        assert friction(speed) < 0.95 * friction(speed, oil=COOL)


def test_friction_grows_with_load_and_never_jumps():
    loads = np.logspace(-6, 6, 4001)
    by_load = np.array([friction(0.1, load) for load in loads])
    assert np.all(np.diff(by_load) > 0.0)
    assert np.diff(np.log(by_load)).max() < 3 * np.diff(np.log(loads))[0]
    speeds = np.logspace(-9, 2, 4001)
    by_speed = np.array([friction(speed, oil=COOL) for speed in speeds])
    assert np.all(np.diff(by_speed) >= 0.0)
    assert np.diff(np.log(by_speed)).max() <= 1.001 * np.diff(np.log(speeds))[0]


@pytest.mark.parametrize("load", [1e-3, 1.0, LOAD])
@pytest.mark.parametrize("speed", [1e-6, 1e-3, 0.3])
def test_growth_is_the_derivative_at_constant_temperature(load, speed):
    area, log_film, log_heat = contact(load)
    oil = COOL.shear_thinning
    _, growth = film_shear(oil, load, area, log_film, log_heat, speed)
    step = 1e-4 * speed
    below, above = (
        film_shear(oil, load, area, log_film, log_heat, v)[0] for v in (speed - step, speed + step)
    )
    error = 2e-12 * EYRING_STRESS * area / (2 * step)  # of the logarithm
    assert growth == pytest.approx((above - below) / (2 * step), rel=1e-6, abs=error)


def test_pitch_points_have_the_modulus_and_width_of_the_scene():
    """So that the areas here are those of the law."""
    assert pytest.approx(2 * OIL.contact_modulus) == MODULUS
    assert OIL.face_width == FACE_WIDTH
