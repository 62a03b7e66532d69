"""Hertz pressures beyond those of the friction laws are reported, by runs and studies."""

import math

import pytest
from command_line import succeed

import planetary_twin_py as pt
from planetary_twin_py.explanation.pressure import pressure_warning

PAPER = pt.load_scene("paper").replace(**{"drive.torque_limit": 2000.0})


def line_contact(scene):
    """Largest pressure of a line contact at the pitch point of a sun mesh [Pa], after ISO 6336-2:
    sqrt(F E / (2 pi (1 - nu^2) b R)) of equal materials."""
    gears, oil = scene.gearset.geometry, scene.lubrication
    radius = [gear.base_radius * math.tan(gears.meshes[0].pressure_angle)
              for gear in (gears.sun, gears.planet)]  # fmt: skip
    relative = 1.0 / (1.0 / radius[0] + 1.0 / radius[1])
    force = scene.operating_point.input_torque / (scene.gearset.planets * gears.sun.base_radius)
    elastic = oil.youngs_modulus / (2.0 * math.pi * (1.0 - oil.poisson_ratio**2))
    return math.sqrt(force * elastic / (scene.gearset.face_width * relative))


def at(pressure):
    """The scene at the torque with this largest pressure [Pa]."""
    here = PAPER.operating_point.input_torque
    return PAPER.replace(input_torque=here * (pressure / line_contact(PAPER)) ** 2)


@pytest.mark.parametrize("dynamics", ["torsional", "quasi_static"])
def test_two_gigapascals_are_the_limit_of_runs(dynamics):
    for pressure, warned in ((1.95e9, False), (2.05e9, True)):
        scene = at(pressure).replace(dynamics=dynamics)
        line = pressure_warning(scene, pt.simulate(scene, 0.004))
        assert (line is not None) == warned
        assert (pressure_warning(scene) is not None) == warned
    assert "2.05 GPa in the sun-planet meshes" in line and "gearset.face_width" in line


def test_without_friction_no_law_is_extrapolated():
    assert pressure_warning(at(3e9).replace(**{"lubrication.friction": False})) is None


def test_a_study_reports_it_once(tmp_path):
    torque = at(2.5e9).operating_point.input_torque
    done = succeed(
        "sweep", "paper", "--set", "drive.torque_limit=2000Nm", "--input-torque",
        f"20Nm,{torque:.4f}Nm", "--duration", "0.004", "--settling", "0",
        "--out", tmp_path / "a.csv",
    )  # fmt: skip
    assert done.stderr.count("Hertz pressure = 2.5 GPa") == 1
