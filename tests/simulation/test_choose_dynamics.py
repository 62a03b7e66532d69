"""`dynamics: auto` picks the least dynamics within a stated error, and says so."""

import json

import numpy as np
import pytest
from command_line import invoke
from planar.moving_scenes import planar
from power_flows import FLOWS

import planetary_twin_py as pt
from planetary_twin_py.explanation.measure import explain
from planetary_twin_py.recording.runs.offline import Plan, record
from planetary_twin_py.simulation.choose_dynamics import choose_dynamics
from planetary_twin_py.units.engineering import percent

PIN = {"errors.pin_tangential": [-2e-5, 0.0, 0.0]}


def by_name(choice):
    return {each.dynamics: each for each in choice.candidates}


def test_soft_bearings_with_an_error_need_moving_axes():
    stiff = choose_dynamics(planar(FLOWS[0], {"bearing": 1e11}).replace(dynamics="auto"))
    soft = choose_dynamics(planar(FLOWS[0], **PIN).replace(dynamics="auto"))
    assert (stiff.dynamics, soft.dynamics) == ("torsional", "planar")
    assert stiff.reference == soft.reference == "planar"
    assert by_name(stiff)["torsional"].error < 0.02 < by_name(soft)["torsional"].error


def test_slow_gears_need_no_vibration():
    slow = pt.load_scene("reference_gearbox_stage").replace(dynamics="auto")
    choice = choose_dynamics(slow)
    assert choice.dynamics == "quasi_static"
    assert choice.reference == "torsional"
    assert "planar is not possible: supports: missing" in choice.reason


def test_the_stated_error_decides():
    scene = planar(FLOWS[0], {"bearing": 1e11}).replace(dynamics="auto")
    error = by_name(choose_dynamics(scene))["torsional"].error
    for allowed, selected in ((1.01 * error, "torsional"), (0.99 * error, "planar")):
        assert choose_dynamics(scene.replace(dynamics_error=allowed)).dynamics == selected


def test_errors_are_those_of_runs_of_both_kinds():
    scene = planar(FLOWS[0], **PIN)
    found = by_name(choose_dynamics(scene))["torsional"].errors
    runs = [
        pt.simulate(scene.replace(dynamics=dynamics), 0.1, settling=0.1)
        for dynamics in ("torsional", "planar")
    ]
    for name in ("dte_mean", "mesh_force_mean", "mesh_force_peak"):
        held, moving = (run.mesh[name] for run in runs)
        expected = np.abs(held - moving).max() / np.abs(moving).max()
        assert found[name] == pytest.approx(expected, rel=1e-3)
    held, moving = (run.mean_power_loss for run in runs)
    assert found["power_loss"] == pytest.approx(abs(held / moving - 1.0), rel=1e-2)


def test_a_result_states_which_dynamics_was_selected():
    scene = planar(FLOWS[0], **PIN)
    run = pt.simulate(scene.replace(dynamics="auto"), 0.005)
    assert run.choice.dynamics == "planar" and run.axes is not None
    assert "1000 rpm and 63 N m" in run.choice.text
    given = pt.simulate(scene, 0.005)
    assert given.choice is None
    assert (run.dte == given.dte).all()


def test_a_twin_refuses_a_scene_with_open_dynamics(tmp_path):
    scene = pt.load_scene("paper").replace(dynamics="auto")
    for run in (
        lambda: pt.Twin(scene),
        lambda: record(Plan(scene, 0.01, 1e4, 1e-3), tmp_path / "run"),
    ):
        with pytest.raises(pt.SceneError, match="dynamics = 'auto': must be selected first"):
            run()


def test_a_driven_scene_runs_in_torsion_and_says_why():
    choice = choose_dynamics(
        pt.load_scene("paper").replace(dynamics="auto", **{"drive.input.port": "torque"})
    )
    assert choice.dynamics == "torsional"
    assert choice.reason.count("requires dynamics other than quasi-static") == 2
    assert choice.reason.count("supports: missing") == 2


@pytest.mark.parametrize(("name", "selected"), [("floating_sun", "planar"), ("paper", "torsional")])
def test_simulate_prints_and_writes_the_selected_dynamics(name, selected, tmp_path):
    command = ["simulate", name, "--set", "dynamics=auto", "--duration", "0.01"]
    out = tmp_path / "run.json"
    printed = invoke(*command, "--json", out).stdout
    assert f"dynamics = {selected}, selected by auto at 1000 rpm" in printed.replace("\n", " ")
    assert json.loads(out.read_text())["dynamics"]["selected"] == selected


def test_explain_compares_the_dynamics_of_a_scene():
    found = explain(pt.load_scene("floating_sun"), 0.005)
    assert found.dynamics.dynamics == "planar"
    costs = [each.cost for each in found.dynamics.candidates]
    assert all(cost > 0.0 for cost in costs)
    printed = invoke("explain", "floating_sun", "--duration", "0.005")
    verdict = " ".join(printed.stdout.split())
    assert "Simplest dynamics within 2 % (dynamics_error): planar. Errors of the others:" in verdict
    simpler = next(each for each in found.dynamics.candidates if each.dynamics == "torsional")
    assert f"torsional {percent(simpler.error)}" in verdict


def test_small_losses_of_slow_gears_are_compared():
    """At a thousandth of its speed `paper` loses some mW."""
    choice = choose_dynamics(pt.load_scene("paper").replace(input_speed=pt.rpm(1.0)))
    one, other = (
        pt.simulate(
            pt.load_scene("paper").replace(input_speed=pt.rpm(1.0), dynamics=dynamics),
            2.0,
            settling=2.0,
        ).mean_power_loss
        for dynamics in ("quasi_static", "torsional")
    )
    expected = abs(one / other - 1.0)
    assert by_name(choice)["quasi_static"].errors["power_loss"] == pytest.approx(expected, rel=0.05)
