"""Surfaces without oil, surfaces far apart, and oil that nothing draws in."""

import numpy as np
import pytest
from scipy.integrate import quad
from stability.sound import PAPER, assert_finite, sound_run

import planetary_twin_py as pt

THINNEST = 1e-9  # [m], of the model
RATIOS = [0.0, 1e-9, 3.0, np.nextafter(3.0, 4.0), 10.0]


def asperity_integral(n, ratio):
    """F_n of Greenwood and Tripp: heights of a Gaussian surface beyond the film."""
    beyond = quad(
        lambda s: (s - ratio) ** n * np.exp(-0.5 * s * s), ratio, ratio + 12.0, epsabs=1e-14
    )
    return beyond[0] / np.sqrt(2.0 * np.pi)


def boundary_shear(scene, ratio):
    """Boundary friction per apparent area [Pa], Salagianni et al. (7)-(11)."""
    oil = scene.lubrication
    modulus = oil.youngs_modulus / (2.0 * (1.0 - oil.poisson_ratio**2))
    area = np.pi**2 * oil.roughness_parameter**2 * asperity_integral(2.0, ratio)
    pressure = 16.0 * np.sqrt(2.0) / 15.0 * np.pi * oil.roughness_parameter**2
    pressure *= np.sqrt(oil.asperity_slope) * modulus * asperity_integral(2.5, ratio)
    return oil.shear_stress * area + oil.pressure_coefficient * pressure


@pytest.mark.parametrize("asperities", ["exact", "printed"])
@pytest.mark.parametrize("ratio", RATIOS)
def test_any_lambda_ratio_is_sound(ratio, asperities):
    scene = PAPER.replace(lambda_ratio=ratio, **{"lubrication.asperities": asperities})
    run = sound_run(scene, 0.01, tolerance=1e-5)
    assert run.boundary_friction.min() >= 0.0
    assert run.lambda_ratio == pytest.approx(ratio)


@pytest.mark.parametrize("ratio", [0.0, 0.5, 2.0])
def test_boundary_friction_without_oil_is_that_of_all_asperities(ratio):
    """In proportion to lambda 1, by quadrature over the heights."""
    found = [
        sound_run(PAPER.replace(lambda_ratio=x), 0.004, tolerance=1e-5).boundary_friction.mean()
        for x in (ratio, 1.0)
    ]
    expected = boundary_shear(PAPER, ratio) / boundary_shear(PAPER, 1.0)
    assert found[0] / found[1] == pytest.approx(expected, rel=3e-3)


def test_beyond_three_sigma_the_film_alone_takes_power():
    runs = [
        sound_run(PAPER.replace(lambda_ratio=x), 0.004, tolerance=1e-5) for x in (0.0, 5.0, 10.0)
    ]
    boundary = [run.boundary_friction.mean() for run in runs]
    assert boundary[1] < 1e-6 * boundary[0] and boundary[2] < boundary[1]
    assert runs[2].power_loss.mean() == pytest.approx(runs[1].power_loss.mean(), rel=1e-6)


@pytest.mark.parametrize("film", ["dowson_higginson", "dowson_toyoda", "salagianni"])
@pytest.mark.parametrize("boundary", ["greenwood_tripp", "load_sharing"])
def test_a_set_that_turns_as_a_block_loses_nothing(film, boundary):
    """Sun and carrier at one speed: no tooth slides or rolls, however fast everything turns."""
    speed = pt.rpm(1000)
    scene = pt.load_scene("differential").replace(
        input_speed=speed,
        second_input_speed=speed,
        **{
            "lubrication.film": film,
            "lubrication.boundary": boundary,
            "lubrication.rolling": "goksem_hargreaves",
            "lubrication.lambda_ratio": "computed",
        },
    )
    run = sound_run(scene, 0.05, tolerance=1e-5)
    assert run.speed[-1] == pytest.approx(np.full(6, speed), rel=1e-3)
    assert run.stats.pair_events == 0
    late = run.power_loss[-200:].sum(axis=1)
    assert late.max() < 1e-6 * abs(speed * scene.operating_point.input_torque)
    assert (run.film_thickness >= THINNEST).all()


@pytest.mark.parametrize("speed", [0.0, 1e-6])
@pytest.mark.parametrize("temperature", [233.15, 433.15])
def test_the_film_of_teeth_that_hardly_move_is_thin_but_there(speed, temperature):
    scene = PAPER.replace(
        input_speed=speed, oil_temperature=temperature, **{"lubrication.lambda_ratio": "computed"}
    )
    run = sound_run(scene, 0.01)
    assert_finite(run)
    assert (run.film_thickness >= THINNEST).all()
    assert run.lambda_ratio == pytest.approx(run.film_thickness / 2e-7, rel=1e-9)
