"""The lost-motion test against closed forms of play and stiffness."""

import json
import math

import numpy as np
import pytest
from command_line import invoke
from tiers import first

import planetary_twin_py as pt
from planetary_twin_py.model.layout import LOAD_MACHINE, Layout
from planetary_twin_py.studies.lost_motion import lost_motion

TORQUE, PLAY = 100.0, 2e-5  # [N m], [m]
SMALL = "input_torque=1 N m"
# 5 planets in phase, so that every mesh yields equally; constant stiffness.
SMOOTH = pt.load_scene("paper").replace(
    **{
        "gearset.planet_angles": tuple(2.0 * math.pi * k / 5 for k in range(5)),
        "gearset.held": "ring",
        "drive.output.member": "carrier",
        "mesh.double_pair_ratio": 1.0,
        "mesh.ramp": 0.0,
        "mesh.damping.law": "viscous",
        "lubrication.friction": False,
        "backlash": PLAY,
    }
)
GEARS = SMOOTH.gearset.geometry
LEVER = GEARS.sun.base_radius + GEARS.ring.base_radius  # of the carrier's angle in both meshes
# Per planet both meshes in series; each branch is wound up by angle times lever.
STIFFNESS = 5 * 0.5 * 2e8 * LEVER**2
FREE_PLAY = 2.0 * PLAY / LEVER  # both meshes, from flank to flank


def test_without_friction_it_is_play_and_elastic_twist():
    found = lost_motion(SMOOTH, TORQUE, levels=20)
    assert found.settled
    assert found.stiffness == pytest.approx(STIFFNESS, rel=1e-3)
    elastic = 2.0 * found.share * TORQUE / STIFFNESS
    assert found.lost_motion == pytest.approx(FREE_PLAY + elastic, rel=1e-3)
    assert np.ptp(found.twist) == pytest.approx(FREE_PLAY + 2.0 * TORQUE / STIFFNESS, rel=1e-3)
    assert found.hysteresis < 1e-3 * FREE_PLAY
    assert not found.hysteresis_resolved
    motor, load = SMOOTH.drive.input, SMOOTH.drive.output
    ratio = 1.0 + SMOOTH.gearset.teeth.ring / SMOOTH.gearset.teeth.sun
    series = 1.0 / found.stiffness + 1.0 / load.coupling_stiffness
    series += 1.0 / (ratio**2 * motor.coupling_stiffness)
    assert found.stiffness_with_couplings == pytest.approx(1.0 / series)


def test_backlash_is_a_step_at_zero_torque_in_both_directions():
    found = lost_motion(SMOOTH, TORQUE, levels=5)
    down, up = found.twist[found.torque == 0.0].reshape(2, 2)
    assert down[0] - down[1] == pytest.approx(FREE_PLAY, rel=1e-3)
    assert up[1] - up[0] == pytest.approx(FREE_PLAY, rel=1e-3)
    turn = int(np.argmin(found.torque))
    assert (np.diff(found.torque[: turn + 1]) <= 0.0).all()
    assert (np.diff(found.torque[turn:]) >= 0.0).all()


def quasi_static_stiffness(scene, torque):
    """Torque on the output over its twist [N m/rad], in a quasi-static run, mean of both senses."""
    stiffness = []
    for sense in (1.0, -1.0):
        driving = sense * torque / Layout(scene).machine_torques[LOAD_MACHINE]
        changes = {"dynamics": "quasi_static", "input_torque": driving, "input_speed": 1e-3}
        dte = pt.simulate(scene.replace(**changes), 1e-3, sample_rate=1e4).dte[0]
        stiffness.append(torque / (abs(dte[0] + dte[5]) / LEVER))
    return np.mean(stiffness)


@pytest.mark.parametrize("torque", [20.0, 400.0])
def test_involute_contacts_are_as_stiff_as_at_the_bench(torque):
    scene = SMOOTH.replace(**{"mesh.stiffness": "involute", "backlash": 0.0})
    found = lost_motion(scene, torque, levels=10)
    assert found.stiffness == pytest.approx(quasi_static_stiffness(scene, torque), rel=0.01)
    light, heavy = (quasi_static_stiffness(scene, each) for each in (1.0, 400.0))
    assert heavy > 1.1 * light


def test_planets_in_phase_are_as_stiff_as_their_pairs():
    teeth = {"sun": 18, "planet": 45, "ring": 108}
    angles = tuple(2.0 * math.pi * k / 3 for k in range(3))
    scene = SMOOTH.replace(
        **{
            "gearset.teeth": teeth,
            "gearset.planet_angles": angles,
            "mesh.stiffness": "involute",
            "backlash": 0.0,
        }
    )
    found = lost_motion(scene, TORQUE, levels=10)
    expected = [
        np.ptp(found.torque[part]) / np.ptp(found.twist[part])
        for part in (found.torque >= 0.5 * TORQUE, found.torque <= -0.5 * TORQUE)
    ]
    assert found.stiffness_by_sense == pytest.approx(expected, rel=1e-3)
    assert expected[0] != pytest.approx(expected[1], rel=0.05)
    assert found.stiffness == pytest.approx(np.mean(expected), rel=1e-3)


@pytest.mark.exhaustive
def test_printed_gears_have_the_figures_of_their_rig():
    # Backlash and output coupling of the scene are chosen so; friction of 0.8, light gears.
    found = lost_motion(pt.load_scene("compact_actuator"), 7.2)
    assert found.settled
    assert math.degrees(found.lost_motion) == pytest.approx(0.591, abs=5e-3)
    assert found.stiffness_with_couplings == pytest.approx(242.7, rel=0.01)


def test_friction_opens_a_loop_that_takes_energy():
    oil = {"lubrication.friction": True, "lubrication.boundary": "load_sharing", "backlash": 0.0}
    smooth = lost_motion(SMOOTH.replace(backlash=0.0), TORQUE, levels=20)
    rough = lost_motion(SMOOTH.replace(**oil), TORQUE, levels=20)
    assert smooth.settled and rough.settled
    assert rough.stiffness == pytest.approx(smooth.stiffness, rel=0.02)

    def taken(loop):
        return -np.trapezoid(loop.twist, loop.torque)

    stored = 0.5 * TORQUE**2 / STIFFNESS
    assert abs(taken(smooth)) < 5e-4 * stored
    assert taken(rough) > 1e-3 * stored


def with_oil_and(play, share):
    oil = {"lubrication.friction": True, "lubrication.boundary": "load_sharing"}
    return lost_motion(SMOOTH.replace(**oil, backlash=play), TORQUE, share, levels=10)


@pytest.mark.parametrize("share", first(1, [0.03, 0.01, 0.1]))
def test_with_friction_too_it_is_backlash_and_elastic_twist(share):
    elastic = 2.0 * share * TORQUE / STIFFNESS
    tight, loose = (with_oil_and(play, share).lost_motion for play in (0.0, PLAY))
    assert tight == pytest.approx(elastic, rel=0.02)
    assert loose == pytest.approx(FREE_PLAY + elastic, rel=1e-3)


@pytest.mark.exhaustive
def test_hysteresis_is_friction_without_the_backlash():
    smooth = lost_motion(SMOOTH, TORQUE, 0.1, levels=10).hysteresis
    runs = [with_oil_and(play, 0.1) for play in (0.0, PLAY)]
    assert all(run.hysteresis_resolved for run in runs)
    tight, loose = (run.hysteresis for run in runs)
    assert tight > 10.0 * smooth
    assert loose == pytest.approx(tight, rel=0.2) and loose < 1e-3 * FREE_PLAY


@pytest.mark.parametrize("held, output", [("carrier", "ring"), ("sun", "carrier")])
def test_any_member_may_be_held(held, output):
    driver = ({"sun", "ring", "carrier"} - {held, output}).pop()
    scene = SMOOTH.replace(
        **{"gearset.held": held, "drive.output.member": output, "drive.input.member": driver}
    )
    found = lost_motion(scene, TORQUE, levels=10)
    lever = {"ring": GEARS.ring.base_radius, "carrier": LEVER}[output]
    assert found.stiffness == pytest.approx(5 * 0.5 * 2e8 * lever**2, rel=1e-3)


def test_the_command_prints_and_draws_what_the_library_finds(tmp_path):
    png, file = tmp_path / "loop.png", tmp_path / "found.json"
    arguments = ["lost-motion", "paper", "--torque", "50 N m"]
    shown = invoke(*arguments, "--picture", png, "--json", file).output
    figures = json.loads(file.read_text())
    found = lost_motion(pt.load_scene("paper"), 50.0)
    assert figures["lost_motion"] == pytest.approx(found.lost_motion)
    assert figures["stiffness"] == pytest.approx(found.stiffness)
    assert figures["stiffness_by_sense"] == pytest.approx(found.stiffness_by_sense)
    assert png.read_bytes().startswith(b"\x89PNG")
    assert "lost motion at 3 % of it [deg]" in shown
