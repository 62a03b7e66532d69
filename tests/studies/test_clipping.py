"""Viscous friction that is clipped to zero is counted in the table of a study, and reported."""

import pytest
from command_line import invoke as run

import planetary_twin_py as pt
from planetary_twin_py.simulation.threads import Threads
from planetary_twin_py.studies.axes import Axis
from planetary_twin_py.studies.measures import clipped_friction
from planetary_twin_py.studies.plan import Settings, grid
from planetary_twin_py.studies.sweep import sweep

SCENE = """
base: paper
name: thick
operating_point: {input_speed: 5000 rpm}
lubrication: {boundary: load_sharing, shear_stress: 20 MPa, viscosity: 0.3, lambda_ratio: computed}
"""
TORQUES = (0.3, 3.0, 63.0)
SIDES = ("sun_planet", "planet_ring")


@pytest.fixture
def thick(tmp_path):
    path = tmp_path / "thick.yaml"
    path.write_text(SCENE)
    return path


def warnings(done):
    assert done.exit_code == 0, done.output
    return [line for line in done.stderr.splitlines() if "warning" in line]


def test_the_clipped_share_is_that_of_a_separate_run():
    scene = pt.parse_scene(SCENE)
    settings = Settings(duration=0.02, settling=0.0)
    table = sweep(grid(scene, [Axis("input_torque", TORQUES)], settings), Threads())
    for torque, row in zip(TORQUES, table.to_pylist(), strict=True):
        alone = clipped_friction(scene, pt.simulate(scene.replace(input_torque=torque), 0.02))
        for side in SIDES:
            found = row[f"{side}_viscous_friction_clipped"]
            assert found == pytest.approx(alone[side], abs=2e-3)
    light, _, heavy = table.to_pylist()
    assert light["efficiency"] == light["sun_planet_viscous_friction_clipped"] == 1.0
    assert heavy["sun_planet_viscous_friction_clipped"] == 0.0


@pytest.mark.parametrize("out", ["study.parquet", "study.png"])
def test_a_sweep_warns_once_with_the_number_of_points(thick, tmp_path, out):
    torques = ["--input-torque", "0.3,3,63", "--duration", 0.02, "--settling", 0]
    (line,) = warnings(run("sweep", thick, *torques, "--out", tmp_path / out))
    assert line.endswith("; at 2 of 3 points")
    light = run("simulate", thick, "--set", "input_torque=0.3", "--duration", 0.02)
    (alone,) = warnings(light)
    assert line == alone.replace("100 %", "up to 100 %") + "; at 2 of 3 points"
