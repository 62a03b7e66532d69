"""`planetary-twin fit` of a manoeuvre, with its report."""

import json
from pathlib import Path

import numpy as np
import pytest
from command_line import run, run_here
from following.plants import played
from tiers import first_rows

from planetary_twin_py.text.intervals import interval_text

RAMP = Path(__file__).parents[1] / "data/compact/ramp.parquet"
DRAG = "losses.sun_drag.coulomb"


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".html", pytest.param(".md", marks=pytest.mark.exhaustive)])
def test_a_manoeuvre_is_fitted_and_reported(tmp_path, suffix):
    report, figures = tmp_path / f"report{suffix}", tmp_path / "fit.json"
    done = run(
        "fit", RAMP, "--scene", "compact_actuator", "--free", DRAG, "--from", 8, "--to", 20,
        "--hold-out", "20.2:30", "--report", report, "--json", figures,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "held out: " in done.stdout and "of processor time" in done.stdout
    found = json.loads(figures.read_text())["parameters"][DRAG]
    assert found["low"] < found["estimate"] < found["high"]
    text = report.read_text()
    shown = interval_text(found["estimate"], found["low"], found["high"])
    assert DRAG in text and all(part in text for part in shown) and "Held out" in text
    picture = (tmp_path / "report-1.png").exists()
    assert picture if suffix == ".md" else "data:image/png;base64," in text


def test_a_manoeuvre_without_a_scene_is_refused_in_one_line():
    done = run_here("fit", RAMP, "--free", DRAG)
    assert done.returncode == 2
    assert "--scene: required for a table of readings over time" in done.stderr


@pytest.mark.parametrize("option", [["--observe", "power_loss"], ["--noise", "power_loss=1"]])
def test_options_of_a_recording_are_refused_for_a_manoeuvre(option):
    done = run_here("fit", RAMP, "--scene", "compact_actuator", "--free", DRAG, *option)
    assert done.returncode == 2
    assert f"{option[0]}: has no effect, because {RAMP} is a manoeuvre" in done.stderr


@pytest.fixture(scope="module")
def steady(tmp_path_factory):
    """Readings of scene `paper` by column."""
    _, time, columns = played("steady", {}, 8.0)
    names = ("input_torque", "output_torque", "input_speed")
    return {"time": time} | {name: columns[name] for name in names}


def fit_of(table, columns, *options):
    np.savetxt(
        table, np.column_stack([*columns.values()]), delimiter=",", header=",".join(columns),
        comments="",
    )  # fmt: skip
    return run_here("fit", table, "--scene", "paper", "--free", DRAG, *options, COLUMNS="200")


@pytest.mark.parametrize(
    ("name", "factor", "line"),
    [
        ("output_torque", -1.0, "output_torque/input_torque = -2."),
        ("input_torque", 1e-3, "must be near 2.333 (no loss)"),
        ("input_speed", 60.0, "exceeds 1.2 times drive.speed_limit"),
    ],
)
def test_a_wrong_sign_or_unit_is_refused_in_one_line(tmp_path, steady, name, factor, line):
    done = fit_of(tmp_path / "rig.csv", steady | {name: factor * steady[name]})
    assert done.returncode == 2 and line in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("factors", "line"),
    first_rows(
        1,
        [
            ({"input_torque": 1e-3, "output_torque": 1e-3}, "is the unit of both torques right?"),
            ({"time": 1e3}, "a table in milliseconds needs the heading time [ms]"),
        ],
    ),
)
def test_a_unit_that_may_be_wrong_is_asked_for(tmp_path, steady, factors, line):
    wrong = {name: factors.get(name, 1.0) * values for name, values in steady.items()}
    done = fit_of(tmp_path / "rig.csv", wrong)
    assert done.returncode == 0 and line.lower() in done.stderr.lower()
