"""Viscous friction that is clipped to zero is counted in the table of a study, and reported."""

import pyarrow.parquet
import pytest
from studies.small import PAPER
from typer.testing import CliRunner

import planetary_twin_py as pt
from planetary_twin_py.cli import build_app
from planetary_twin_py.studies import sweep as module
from planetary_twin_py.studies.axes import Axis
from planetary_twin_py.studies.local import Threads
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


def run(*arguments):
    return CliRunner().invoke(build_app(), [*map(str, arguments)])


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


def test_nothing_is_clipped_without_friction():
    scene = PAPER.replace(**{"lubrication.friction": False})
    settings = Settings(duration=0.005, settling=0.0)
    (row,) = sweep(grid(scene, [Axis("input_torque", (1.0,))], settings), Threads()).to_pylist()
    assert [row[f"{side}_viscous_friction_clipped"] for side in SIDES] == [0.0, 0.0]


@pytest.mark.parametrize("out", ["study.parquet", "study.png"])
def test_a_sweep_warns_once_with_the_number_of_points_in_the_words_of_simulate(
    thick, tmp_path, out
):
    torques = ["--input-torque", "0.3,3,63", "--duration", 0.02, "--settling", 0]
    (line,) = warnings(run("sweep", thick, *torques, "--out", tmp_path / out))
    assert line.endswith("; at 2 of 3 points")
    light = run("simulate", thick, "--set", "input_torque=0.3", "--duration", 0.02)
    (alone,) = warnings(light)
    assert line == alone.replace("100 %", "up to 100 %") + "; at 2 of 3 points"


def test_a_stribeck_curve_warns_of_it_too(thick, tmp_path):
    def warned(torque):
        out = ["--input-speed", "1000rpm:5000rpm:3:log", "--out", tmp_path / "curve.parquet"]
        return warnings(run("stribeck", thick, "--set", f"input_torque={torque}", *out))

    (line,) = warned(0.3)
    assert "viscous friction is clipped to zero" in line and "at 3 of 3 points" in line
    table = pyarrow.parquet.read_table(tmp_path / "curve.parquet")
    assert table["sun_planet_viscous_friction_clipped"].to_pylist() == [1.0] * 3
    assert warned(63) == []


def test_points_that_failed_are_not_counted(thick, tmp_path):
    fields = ["--gearset.addendum", "0.3,1.0", "--set", "input_torque=0.3"]
    done = run(
        "sweep", thick, *fields, "--duration", 0.02, "--settling", 0, "--out", tmp_path / "a.csv"
    )
    (line,) = warnings(done)
    assert line.endswith("; at 1 of 2 points")


def test_a_journal_with_other_quantities_is_left_unchanged(tmp_path, monkeypatch):
    """One of an earlier version, whose rows lack a column."""
    study = grid(PAPER, [Axis("input_torque", (20.0,))], Settings(duration=0.005, settling=0.0))
    journal = tmp_path / "journal"
    with monkeypatch.context() as earlier:
        earlier.setattr(module, "STUDY_RESULTS", {"efficiency": None})
        sweep(study, Threads(1), journal)
    lines = journal.read_text().splitlines()
    sweep(study, Threads(1), journal)
    assert len(journal.read_text().splitlines()) == len(lines) + 1
