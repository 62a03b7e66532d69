"""Viscous friction that is clipped to zero is reported: known loads, and samples made here."""

from dataclasses import replace

import numpy as np
import pytest
from command_line import succeed

import planetary_twin_py as pt
from planetary_twin_py.explanation.remarks import remarks
from planetary_twin_py.studies.measures import clipped_friction

HEAVY = pt.load_scene("paper")
# 0.03 um is where the plateau ends without pressure: a tenth of the film.
LIGHT = HEAVY.replace(
    input_torque=0.3, **{"lubrication.shear_stress": "20 MPa", "lubrication.viscosity": 0.03}
)


@pytest.fixture(scope="module")
def heavy():
    return pt.simulate(HEAVY, 0.01)


def test_a_heavy_load_has_viscous_friction_throughout(heavy):
    assert clipped_friction(HEAVY, heavy) == {"sun_planet": 0.0, "planet_ring": 0.0}
    assert list(remarks(HEAVY, heavy, 1e-4)) == []


@pytest.mark.parametrize("dynamics", ["torsional", "quasi_static"])
def test_a_light_load_has_none_and_that_is_reported(dynamics):
    scene = LIGHT.replace(dynamics=dynamics)
    run = pt.simulate(scene, 0.01)
    assert run.boundary_friction.max() > 0.0
    assert clipped_friction(scene, run) == {"sun_planet": 1.0, "planet_ring": 1.0}
    (line,) = remarks(scene, run, 1e-4)
    assert "for 100 % (sun-planet meshes) and 100 % (planet-ring meshes) of the time" in line


def test_teeth_that_have_parted_are_not_clipped(heavy):
    """Rattling: neither force nor friction for a while."""
    run = pt.simulate(pt.load_scene("lightly_loaded"), 0.1)
    assert run.mesh["contact_fraction"].max() < 0.99
    assert (run.mesh["without_viscous"] <= run.mesh["contact_fraction"]).all()
    parted = {"contact_fraction": np.zeros(6), "without_viscous": np.zeros(6)}
    assert set(clipped_friction(HEAVY, replace(heavy, mesh=heavy.mesh | parted)).values()) == {0.0}


def test_a_film_that_carries_all_of_the_load_is_reported_too():
    """Then there is no boundary friction either, and an efficiency of 1."""
    scene = LIGHT.replace(lambda_ratio=3.0, **{"lubrication.boundary": "load_sharing"})
    run = pt.simulate(scene, 0.006)
    assert run.efficiency == 1.0
    assert set(clipped_friction(scene, run).values()) == {1.0}


@pytest.mark.parametrize("command", ["simulate", "explain"])
def test_the_commands_warn_in_one_line(command, tmp_path):
    light = tmp_path / "light.yaml"
    light.write_text(
        "base: paper\nname: light\noperating_point: {input_torque: 0.3}\n"
        "lubrication: {shear_stress: 20 MPa, viscosity: 0.03}\n"
    )
    for scene, lines in ((str(light), 1), ("paper", 0)):
        done = succeed(command, scene, "--duration", "0.006")
        warned = done.stderr.splitlines()
        assert len(warned) == lines
        assert all("viscous friction is clipped to zero" in line for line in warned)
