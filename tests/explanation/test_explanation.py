"""What a scene says of itself, against runs made here."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

import planetary_twin_py as pt
from planetary_twin_py.cli import build_app
from planetary_twin_py.explanation.measure import explain
from planetary_twin_py.explanation.terms import limits, terms

SCENES = pytest.mark.parametrize("name", pt.packaged_scenes())


def names(scene):
    return [term.name for term in terms(scene)]


@SCENES
def test_every_term_can_be_left_out_and_is_then_off(name):
    scene = pt.load_scene(name)
    for term in terms(scene):
        without = scene.replace(**term.without)
        assert without != scene
        if term.name != "asperities":  # only ever smoothed away
            assert term.name not in names(without)


def test_a_term_that_is_off_is_not_listed():
    bare = pt.load_scene("paper").replace(
        backlash=0.0, **{"mesh.ramp": 0.0, "lubrication.friction": False}
    )
    assert names(bare) == ["torsional dynamics", "alternation of tooth pairs", "mesh damping"]


def test_a_quasi_static_scene_says_that_dynamics_is_left_out():
    still = pt.load_scene("paper").replace(dynamics="quasi_static")
    assert {"torsional dynamics", "mesh damping"} == set(names(pt.load_scene("paper"))) - set(
        names(still)
    )
    assert limits(still)[0].name == "dynamics"
    assert limits(pt.load_scene("paper")) == limits(still)[1:]


def test_what_leaving_friction_out_changes_is_what_two_runs_differ_by():
    scene = pt.load_scene("paper")
    found = explain(scene, 0.02)
    effect = next(e for e in found.effects if e.term.name == "tooth friction")
    run = pt.simulate(scene, 0.02, tolerance=1e-3)
    late = run.time > 0.005
    assert found.figures.power_loss == pytest.approx(run.total_power_loss[late].mean())
    assert found.figures.dte == pytest.approx(np.abs(run.dte[late].mean(axis=0)).mean())
    assert effect.without.power_loss == 0.0
    assert 0.1 < effect.cost < 0.9


def test_the_command_prints_terms_and_limits_and_figures_for_machines():
    runner = CliRunner()
    shown = runner.invoke(build_app(), ["explain", "paper", "--duration", "0.005"])
    assert shown.exit_code == 0
    assert "backlash" in shown.output and "Left out" in shown.output
    figures = runner.invoke(build_app(), ["explain", "paper", "--duration", "0.005", "--json", "-"])
    data = json.loads(figures.stdout)
    assert data["scene"]["power_loss"] > 0.0
    assert [term["name"] for term in data["terms"]] == names(pt.load_scene("paper"))


def test_an_unknown_scene_ends_in_one_line():
    result = CliRunner().invoke(build_app(), ["explain", "nowhere"])
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1 and "nowhere" in result.stderr
