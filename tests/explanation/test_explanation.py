"""What a scene says of itself, against runs made here."""

import json

import numpy as np
import pytest
from command_line import invoke, succeed

import planetary_twin_py as pt
from planetary_twin_py.explanation.losses import losses_in_words
from planetary_twin_py.explanation.measure import explain
from planetary_twin_py.explanation.terms import TRANSVERSE_RACK, limits, terms

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


def test_a_quasi_static_scene_says_that_dynamics_is_left_out():
    still = pt.load_scene("paper").replace(dynamics="quasi_static")
    assert {"torsional dynamics", "mesh damping"} == set(names(pt.load_scene("paper"))) - set(
        names(still)
    )
    assert limits(still)[0].name == "vibration"
    assert limits(pt.load_scene("paper")) == limits(still)[1:]


def test_scene_with_helix_names_effects_that_are_not_modelled():
    straight = pt.load_scene("paper")
    helical = straight.replace(**{"gearset.helix_angle": "-15 deg"})
    further = [limit.name for limit in limits(helical) if limit not in limits(straight)]
    assert further == ["axial forces", "rack of the normal plane"]
    drawn = {"gearset.module": None, "gearset.pressure_angle": None}
    drawn |= {"gearset.normal_module": 0.8e-3, "gearset.normal_pressure_angle": "20 deg"}
    assert TRANSVERSE_RACK not in limits(helical.replace(**drawn))
    assert limits(helical)[0].name == "axial forces"
    assert limits(pt.load_scene("wind_turbine_stage"))[0].name == "axial forces"
    assert limits(pt.load_scene("helical_stage"))[0].name == "shuttling"


def test_the_effect_of_friction_is_the_difference_of_two_runs():
    scene = pt.load_scene("paper")
    found = explain(scene, 0.02)
    effect = next(e for e in found.effects if e.term.name == "tooth friction")
    run = pt.simulate(scene, 0.02)
    other = pt.simulate(scene.replace(**{"lubrication.friction": False}), 0.02)
    assert found.figures["power_loss"] == run.energy.loss / run.duration
    assert found.figures["dte_peak"] == run.mesh["dte_peak"].max()
    assert found.figures["dte_peak"] == pytest.approx(np.abs(run.dte).max(), rel=5e-3)
    assert effect.without["dte_mean"] == pytest.approx(other.dte[1:].mean(), rel=1e-3)
    assert effect.without["power_loss"] == 0.0


@pytest.mark.parametrize("name", ["paper", "wind_turbine_stage", "lightly_loaded"])
def test_explain_and_simulate_print_same_figures_of_the_same_run(name):
    explained = [
        json.loads(invoke(*command, "--json", "-").stdout)
        for command in (
            ["explain", name, "--duration", "0.01"],
            ["simulate", name, "--duration", "0.01"],
        )
    ]
    names = {
        "power_loss": "mean_power_loss_W",
        "dte_mean": "mean_dte_m",
        "dte_rms": "dte_vibration_rms_m",
        "dte_peak": "dte_peak_m",
        "mesh_force_mean": "mean_mesh_force_N",
        "mesh_force_peak": "mesh_force_peak_N",
    }
    assert explained[0]["scene"] == {mine: explained[1][its] for mine, its in names.items()}
    assert explained[0]["remarks"] == explained[1]["remarks"]


LOSSES = {
    "losses.planet_bearing": {"mean_diameter": 0.01},
    "losses.sun_drag": {"coulomb": 0.1},
    "losses.churning": {"fill": 0.1, "gap": 0.01, "carrier": 0.05},
}


@pytest.mark.parametrize(
    "changes, missing, words",
    [
        (
            {},
            "bearings, seals and grease, churning",
            "tooth friction only, without bearings, seals and grease, churning",
        ),
        (LOSSES, None, "tooth friction, bearings, seals and grease, churning"),
        (
            LOSSES | {"lubrication.friction": False},
            "tooth friction",
            "bearings, seals and grease, churning, without tooth friction",
        ),
    ],
)
def test_losses_that_a_scene_leaves_out_are_named(changes, missing, words):
    scene = pt.load_scene("paper").replace(**changes)
    assert losses_in_words(scene) == words
    named = [limit for limit in limits(scene) if limit.name.startswith("losses: ")]
    assert [limit.name for limit in named] == ([f"losses: {missing}"] if missing else [])
    assert all(words in limit.meaning for limit in named)


def test_the_command_prints_terms_and_limits_and_figures():
    shown = succeed("explain", "paper", "--duration", "0.005")
    assert "backlash" in shown.output and "Limits of the model" in shown.output
    figures = invoke("explain", "paper", "--duration", "0.005", "--json", "-")
    data = json.loads(figures.stdout)
    assert data["scene"]["power_loss"] > 0.0
    assert [term["name"] for term in data["terms"]] == names(pt.load_scene("paper"))
    assert data["mesh_frequency"] == pytest.approx(500.0)
    assert data["meshes"]["planet_ring"]["teeth"] == [20, 70]
