"""The command `sweep` as typed."""

import math
from functools import partial

import command_line
import pyarrow.parquet
import pytest

from planetary_twin_py.cli._study import kept

run = partial(command_line.invoke, "sweep")
succeed = partial(command_line.succeed, "sweep")

QUICK = ["--duration", "0.02", "--settling", "0", "--tolerance", "1e-3"]


def test_any_field_is_an_option_of_a_sweep(tmp_path):
    out = tmp_path / "study.parquet"
    fields = ["--lambda-ratio", "1:2:2", "--mesh.damping.loss_factor=0.009,0.02"]
    succeed("paper", *fields, "--out", out, *QUICK)
    table = pyarrow.parquet.read_table(out)
    assert table.column_names[1:3] == ["lambda_ratio", "mesh.damping.loss_factor"]
    assert len(table) == 4 and list(tmp_path.iterdir()) == [out]


def test_settings_apply_at_every_point(tmp_path):
    out = tmp_path / "study.parquet"
    fixed = ["--set", "drive.speed_limit=20000rpm", "--set=lambda_ratio=2"]
    succeed("paper", *fixed, "--input-speed", "11000rpm,12000rpm", "--out", out, *QUICK)
    table = pyarrow.parquet.read_table(out)
    assert table["sun_planet_lambda_ratio"].to_pylist() == pytest.approx([2.0, 2.0], rel=1e-12)
    assert table["mesh_frequency"].to_pylist() == pytest.approx([5500.0, 6000.0], rel=1e-3)


@pytest.mark.parametrize(
    ("dynamics", "held"), [("planar", 0), ("quasi_static_planar,planar", 0), ("torsional", 1)]
)
def test_warnings_are_about_the_scenes_that_are_computed(dynamics, held, tmp_path):
    done = succeed(
        "floating_sun", "--set", "dynamics=torsional", "--dynamics", dynamics,
        "--supports.sun.bearing", "1e6N/m,1e7N/m", "--duration", "0.004", "--settling", "0",
        "--out", tmp_path / "s.csv",
    )  # fmt: skip
    assert done.stderr.count("holds all axes") == held
    assert done.stderr.count("supports.sun.bearing: has no effect") == held


def test_a_helix_angle_is_swept_at_a_constant_normal_module(tmp_path):
    """The base radius grows with m_n/cos(beta): F = 2 T cos(beta)/(3 z m_n cos(alpha_t))."""
    out = tmp_path / "helix.parquet"
    drawing = tmp_path / "drawing.yaml"
    drawing.write_text(
        "base: paper\nname: drawing\ngearset: {module: null, pressure_angle: null, "
        "normal_module: 0.8 mm, normal_pressure_angle: 20 deg}\n"
    )
    options = ["--set", "lubrication.friction=false", "--out", out, *QUICK]
    succeed(drawing, "--gearset.helix_angle", "0deg,10deg,20deg", *options)
    found = pyarrow.parquet.read_table(out)["sun_planet_mesh_force_mean"].to_pylist()
    cosines = [math.cos(math.radians(degrees)) for degrees in (0.0, 10.0, 20.0)]
    transverse = [math.atan(math.tan(math.radians(20.0)) / cosine) for cosine in cosines]
    expected = [
        2.0 * 63.0 * cosine / (3.0 * 30 * 0.8e-3 * math.cos(angle))
        for cosine, angle in zip(cosines, transverse, strict=True)
    ]
    assert found == pytest.approx(expected, rel=1e-2)


def test_an_interrupted_study_says_how_to_continue(tmp_path, capsys):
    journal = tmp_path / "study.parquet.journal"
    journal.write_text('{"key": "a", "figures": {}}\n' * 3)
    with pytest.raises(KeyboardInterrupt), kept(journal, 40):
        raise KeyboardInterrupt
    said = capsys.readouterr().err
    assert f"3 of 40 points are kept in {journal}; repeat the command to continue" in said


def test_a_distribution_has_percentiles_and_a_histogram(tmp_path):
    out = tmp_path / "tolerance.png"
    arguments = ["paper", "--set", "dynamics=quasi_static", "--samples", "12", "--duration", "0.01"]
    arguments += ["--settling", "0", "--backlash", "normal(2 um,0.1 um)", "--y", "efficiency"]
    done = succeed(*arguments, "--out", out)
    assert "50 %" in done.stdout and "efficiency" in done.stdout
    assert out.stat().st_size > 0
    wrong = run(*arguments, "--y", "eff", "--out", out)
    assert wrong.exit_code == 2 and "--y = 'eff': must be one of" in wrong.stderr
