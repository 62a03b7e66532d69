"""`planetary-twin fit` of a manoeuvre, with its report."""

import json
from pathlib import Path

import pytest
from command_line import run, run_here

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


@pytest.mark.parametrize("option", [["--observe", "power_loss"], ["--noise", "power_loss=1"]])
def test_options_of_a_recording_are_refused_for_a_manoeuvre(option):
    done = run_here("fit", RAMP, "--scene", "compact_actuator", "--free", DRAG, *option)
    assert done.returncode == 2
    assert f"{option[0]}: has no effect, because {RAMP} is a manoeuvre" in done.stderr
