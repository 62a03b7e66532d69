"""Teeth that yield beyond linear elasticity are reported, by runs and studies."""

import pytest
from command_line import invoke

import planetary_twin_py as pt
from planetary_twin_py.explanation.deflection import deflection_warning

PAPER = pt.load_scene("paper")


def yielding(modules, **changes):
    """The paper's teeth with a constant stiffness of the sun meshes that yields by this."""
    gears, module = PAPER.gearset.geometry, PAPER.gearset.module
    force = PAPER.operating_point.input_torque / (3 * gears.sun.base_radius)
    stiffness = force / (modules * module)
    return PAPER.replace(**{
        "mesh.stiffness": "given", "mesh.double_pair_ratio": 1.0, "mesh.ramp": 0.0,
        "mesh.sun_planet_stiffness": stiffness, "mesh.planet_ring_stiffness": 2.0 * stiffness,
    } | changes)  # fmt: skip


@pytest.mark.parametrize("modules", [0.095, 0.105])
def test_a_tenth_of_the_module_is_the_limit_of_scenes(modules):
    line = deflection_warning(yielding(modules))
    assert (line is not None) == (modules > 0.1)
    if line:
        assert "sun-planet meshes, 0.1 modules" in line and "mesh.stiffness = given" in line


@pytest.mark.parametrize("modules", [0.09, 0.12])
def test_a_tenth_of_the_module_is_the_limit_of_runs(modules):
    scene = yielding(modules, dynamics="quasi_static")
    assert (deflection_warning(scene, pt.simulate(scene, 0.004)) is None) == (modules < 0.1)


def test_a_modulus_in_megapascals_is_reported(tmp_path):
    soft = ["--set", "mesh.stiffness=involute", "--set", "lubrication.youngs_modulus=206 MPa"]
    for command in (
        ["simulate", "paper", "--duration", "0.004", "--set", "input_torque=20 N m"],
        ["sweep", "paper", "--input-torque", "10Nm,20Nm", "--duration", "0.004",
         "--settling", "0", "--out", str(tmp_path / "a.csv")],
    ):  # fmt: skip
        done = invoke(*command, *soft)
        assert done.stderr.count("warning: deflection of the teeth = ") == 1, done.output
        assert "lubrication.youngs_modulus" in done.stderr
