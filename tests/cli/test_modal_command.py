"""The command `modal` against the library."""

import json
from functools import partial

import command_line
import pytest

import planetary_twin_py as pt
from planetary_twin_py.scene.support_rules import BODIES

invoke = partial(command_line.invoke, "modal")
succeed = partial(command_line.succeed, "modal")


@pytest.mark.parametrize(
    "scene, model",
    [("paper", "torsional"), ("paper", "printed"), ("wind_turbine_stage", "spatial")],
)
def test_figures_are_those_of_the_library(scene, model):
    figures = json.loads(invoke(scene, "--model", model, "--json", "-").stdout)
    modes = pt.natural_modes(pt.load_scene(scene), model)
    assert figures["frequencies_hz"] == pytest.approx(modes.frequencies.tolist())
    assert figures["kinds"] == list(modes.kinds)
    mean = pt.natural_modes(pt.load_scene(scene), model, stiffness="mean")
    assert figures["mean_stiffness"]["frequencies_hz"] == pytest.approx(mean.frequencies.tolist())
    assert figures["mean_stiffness"]["kinds"] == list(mean.kinds)
    for resonance in figures["resonances"]:
        assert resonance["frequency"] == pytest.approx(mean.frequencies[resonance["mode"]])


@pytest.mark.parametrize(
    "scene, dynamics, model",
    [
        ("helical_stage", "spatial", "spatial"),
        ("helical_stage", "quasi_static_planar", "planar"),
        ("helical_stage", "torsional", "torsional"),
        ("floating_sun", "planar", "planar"),
        ("paper", "quasi_static", "torsional"),
    ],
)
def test_the_model_is_that_of_the_dynamics_of_the_scene(scene, dynamics, model):
    options = ("--set", f"dynamics={dynamics}", "--json", "-")
    found, asked = (
        json.loads(invoke(scene, *options, *more).stdout) for more in ((), ("--model", model))
    )
    assert found == asked
    modes = pt.natural_modes(pt.load_scene(scene).replace(dynamics=dynamics))
    assert found["frequencies_hz"] == pytest.approx(modes.frequencies.tolist())
    assert f"{model} model" in invoke(scene, *options[:2]).output


def test_modes_of_auto_are_those_of_the_selected_dynamics():
    shown = invoke("floating_sun", "--set", "dynamics=auto", "--set", "dynamics_error=0.5").output
    assert "torsional model" not in shown and "planar model" in shown


def test_bearings_that_are_linear_about_their_load_are_named():
    clearance = ("--set", "supports.planet.clearance=10um")
    shown = " ".join(invoke("floating_sun", *clearance).stderr.split())
    assert "warning: supports.planet: a bearing with clearance" in shown and "63 N m" in shown
    for quiet in (("floating_sun",), ("floating_sun", *clearance, "--model", "torsional")):
        assert "clearance" not in invoke(*quiet).stderr


def test_planets_without_load_are_named():
    late = ("--set", "errors.pin_tangential=[100 um, 0 um, 0 um]", "--set", "backlash=300um")
    shown = " ".join(invoke("paper", *late).stderr.split())
    assert "warning: in static equilibrium at input_torque = 63 N m" in shown
    assert "meshes of planet 1 without load, so without stiffness" in shown
    for quiet in (("paper",), ("paper", *late, "--model", "printed")):
        assert "stiffness" not in invoke(*quiet).stderr


def test_a_change_of_stiffness_is_that_of_unequal_planets_too():
    """A change of the stiffness of all meshes of a kind by 1 %, in whatever order planets are."""
    found = [
        invoke("paper", "--set", f"errors.planet_stiffness={factors}").output.split("Resonances")[0]
        for factors in ("[0.5, 1.0, 1.0]", "[1.0, 1.0, 0.5]")
    ]
    assert found[0] == found[1]


def test_modes_of_a_turning_carrier_are_those_of_the_library():
    options = ("--model", "planar", "--input-speed", "10rpm")
    figures = json.loads(invoke("wind_turbine_stage", *options, "--json", "-").stdout)
    modes = pt.natural_modes(
        pt.load_scene("wind_turbine_stage"), "planar", input_speed=pt.rpm(10.0)
    )
    assert figures["frequencies_hz"] == pytest.approx(modes.frequencies.tolist())
    assert "input at 10 rpm" in invoke("wind_turbine_stage", *options).output


def test_resonances_use_the_speed_of_the_second_motor():
    shown = " ".join(invoke("differential", "--set", "drive.speed_limit=20000rpm").output.split())
    assert "the second one at -500 rpm (second_input_speed)" in shown
    assert " 2784.2 rpm: harmonic 5 of the mesh frequency meets mode 3 at 8210.6 Hz" in shown
    stood = invoke("differential", "--set", "second_input_speed=0rpm").output
    assert "second" not in stood and " -" not in stood.split("Resonances")[1]


def test_suppressed_modes_are_listed_apart_from_the_resonances():
    options = ("wind_turbine_stage", "--model", "planar")
    shown = " ".join(invoke(*options).output.split())
    resonant, suppressed = shown.split("Frequencies that meet without resonance")
    assert "harmonic 5 of the mesh frequency meets mode 6 at" in resonant
    assert "meets modes 2, 3 at 34.3 Hz, suppressed by phasing" in suppressed
    assert "suppressed" not in resonant and "mode 6" not in suppressed
    figures = json.loads(invoke(*options, "--json", "-").stdout)["resonances"]
    assert {r["kind"]: r["excitation"] for r in figures} == {
        "rotational": "excited",
        "translational": "suppressed by phasing",
    }


def test_campbell_diagram_is_drawn(tmp_path):
    png = tmp_path / "campbell.png"
    assert invoke("wind_turbine_stage", "--model", "planar", "--campbell", str(png)).exit_code == 0
    assert png.read_bytes().startswith(b"\x89PNG")


def test_spatial_modes_warn_of_missing_stiffnesses():
    done = succeed("floating_sun", "--model", "spatial")
    assert "warning: supports.sun.axial, supports.sun.tilting" in done.stderr
    assert "missing, so without stiffness" in done.stderr
    given = [f"supports.{body}.{way}=0" for body in BODIES for way in ("axial", "tilting")]
    sets = [word for each in given for word in ("--set", each)]
    done = invoke("floating_sun", "--model", "spatial", *sets)
    assert done.exit_code == 0 and "missing, so without stiffness" not in done.stderr
