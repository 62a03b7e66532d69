"""Friction and pressure of helical teeth against closed forms of the inclined line of contact."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.explanation.meshes import describe_meshes

MU = 0.07
TABLE = {"coefficient": [MU]}


def helical(**changes):
    return pt.load_scene("helical_stage").replace(dynamics="torsional", **changes)


def cos_base_helix(scene):
    gearset = scene.gearset
    return math.cos(math.atan(math.tan(gearset.helix_angle) * math.cos(gearset.pressure_angle)))


@pytest.mark.parametrize("dynamics", ["torsional", "quasi_static"])
def test_friction_is_that_of_the_normal_load(dynamics):
    """F mu/cos(beta_b), with F in the transverse plane and a constant coefficient mu."""
    scene = helical(**{"lubrication.traction": "table", "lubrication.friction_table": TABLE})
    run = pt.simulate(scene.replace(dynamics=dynamics), 0.02, settling=0.02)
    friction = run.boundary_friction + run.viscous_friction
    expected = MU * np.abs(run.mesh_force) / cos_base_helix(scene)
    assert friction == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("method", ["collocation", "rosenbrock"])
def test_both_methods_have_the_same_friction_of_helical_teeth(method):
    scene = helical()
    loss = [
        pt.simulate(scene, 0.05, settling=0.05, tolerance=1e-5, method=each).mesh["power_loss"]
        for each in ("auto", method)
    ]
    assert loss[0] == pytest.approx(loss[1], rel=1e-3)


def test_pressure_is_that_of_curvature_normal_to_line_of_contact():
    """p = sqrt(F E*/(pi L R)) (Johnson 1985, eq. 4.45), R = R_t/cos(beta_b)."""
    scene = helical()
    figures = describe_meshes(scene).sun_planet
    mesh, oil = scene.gearset.geometry.meshes[0], scene.lubrication
    rho1, rho2 = mesh.curvatures
    radius = rho1 * rho2 / (rho1 + rho2) / cos_base_helix(scene)
    modulus = oil.youngs_modulus / (2.0 * (1.0 - oil.poisson_ratio**2))
    line_load = figures.static_force / scene.gearset.face_width
    pressure = math.sqrt(line_load * modulus / (math.pi * radius))
    assert figures.pitch_pressure == pytest.approx(pressure, rel=1e-9)


def test_the_loss_factor_counts_the_longer_lines_of_contact():
    """H_v of helical gears is that of their transverse section over cos(beta_b) (Niemann)."""
    scene = helical()
    figures = describe_meshes(scene).sun_planet
    first, second = figures.teeth
    shares = 1.0 - figures.contact_ratio + figures.approach**2 + figures.recess**2
    transverse = math.pi * (1.0 / first + 1.0 / second) * shares
    assert figures.loss_factor == pytest.approx(transverse / cos_base_helix(scene), rel=1e-12)
