"""The Stribeck curve of a scene with the default laws, starting at standstill."""

import numpy as np
import pytest
from command_line import invoke

import planetary_twin_py as pt
from planetary_twin_py.model.layout import Layout
from planetary_twin_py.simulation.threads import Threads
from planetary_twin_py.studies.axes import Axis
from planetary_twin_py.studies.stribeck import stribeck
from planetary_twin_py.studies.table import read


@pytest.mark.parametrize("side", ["sun_planet", "planet_ring"])
def test_friction_rises_as_the_film_vanishes(side):
    speeds = tuple(pt.rpm(rpm) for rpm in np.logspace(-3, 1, 21))
    scene = pt.load_scene("wind_turbine_stage")
    table = stribeck(scene, Axis("input_speed", speeds), Threads())
    figures = {name: np.array(table[name].to_pylist()) for name in table.column_names}
    parts = ("boundary_friction", "viscous_friction")
    friction = sum(figures[f"{side}_{part}"] for part in parts)
    mu = friction / np.abs(figures[f"{side}_mesh_force_mean"])
    mixed = figures[f"{side}_lambda_ratio"] < 2.0
    assert mixed.sum() > 15
    assert np.all(np.diff(mu[mixed]) < 0.0)
    assert mu[0] > 0.09 > 0.065 > mu[mixed][-1]


@pytest.mark.parametrize(
    ("name", "dynamics", "used"),
    [
        ("floating_sun", "planar", "quasi_static_planar"),
        ("floating_sun", "torsional", "quasi_static"),
        ("floating_sun", "quasi_static_planar", "quasi_static_planar"),
        ("helical_stage", "spatial", "quasi_static_spatial"),
    ],
)
def test_axes_move_in_a_stribeck_curve_as_in_the_scene(name, dynamics, used, tmp_path):
    out = tmp_path / "curve.parquet"
    arguments = ["stribeck", name, "--input-speed", "5rpm,10rpm", "--out", str(out)]
    done = invoke(*arguments, "--set", f"dynamics={dynamics}")
    assert done.exit_code == 0 and f"dynamics = {used}" in done.stdout, done.output
    held = used == "quasi_static"
    assert ("holds all axes" in done.stderr) == held
    table = read(out)
    assert table["failure"].null_count == 2
    changes = {"dynamics": used, "lubrication.lambda_ratio": "computed", "input_speed": pt.rpm(10)}
    scene = pt.load_scene(name).replace(**changes)
    run = pt.simulate(scene, 1.0 / Layout(scene).mesh_frequency)
    planets = scene.gearset.planets
    friction = run.mesh["viscous_friction"][planets:].mean()
    found = table["planet_ring_viscous_friction"].to_pylist()[-1]
    assert found == pytest.approx(friction, rel=2e-3)
