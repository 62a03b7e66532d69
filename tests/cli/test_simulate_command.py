"""The command `simulate` against the library it calls."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

import planetary_twin_py as pt
from planetary_twin_py.cli import build_app

SHORT = ["--duration", "0.004", "--set", "lambda_ratio=1.5", "--set", "mesh.ramp=0.05"]


def invoke(*arguments):
    return CliRunner().invoke(build_app(), ["simulate", *arguments])


def expected():
    scene = pt.load_scene("paper").replace(lambda_ratio=1.5, **{"mesh.ramp": 0.05})
    return pt.simulate(scene, 0.004)


def test_figures_are_those_of_the_library():
    figures = json.loads(invoke("paper", *SHORT, "--json", "-").stdout)
    run = expected()
    assert figures["efficiency"] == pytest.approx(run.efficiency)
    assert figures["mean_power_loss_W"] == pytest.approx(run.total_power_loss.mean())


def test_samples_are_written_whole(tmp_path):
    run = expected()
    for name in ("run.npz", "run.csv"):
        assert invoke("paper", *SHORT, "--out", str(tmp_path / name)).exit_code == 0
    stored = np.load(tmp_path / "run.npz")
    assert np.array_equal(stored["dte"], run.dte)
    assert tuple(stored["meshes"]) == run.meshes
    table = np.genfromtxt(tmp_path / "run.csv", delimiter=",", names=True, deletechars="")
    assert table["dte/sun_planet_2"] == pytest.approx(run.dte[:, 1])
    assert len(table.dtype.names) == 1 + 2 * 6 + 7 * 6


@pytest.mark.parametrize(
    "arguments, word",
    [
        (("nowhere",), "nowhere"),
        (("paper", "--set", "mesh.ramp"), "NAME=VALUE"),
        (("paper", "--set", "mesh.rump=1"), "mesh.rump: no such field"),
        (("paper", "--set", "lambda_ratio=11"), "within 0 and 10"),
        (("paper", "--duration", "-1"), "duration"),
        (("paper", "--out", "run.txt"), "run.txt"),
    ],
)
def test_what_cannot_be_ends_in_one_line(arguments, word):
    result = invoke(*arguments)
    assert result.exit_code == 2
    assert word in result.stderr and result.stderr.count("\n") == 1
