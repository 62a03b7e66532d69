"""Runs with moving axes against torsion, statics, natural modes and balances."""

import re

import numpy as np
import pytest
from planar.moving_scenes import MASSES, evenly, planar
from planar.published_set import scene as published
from power_flows import DIFFERENTIALS, FLOWS, flow_name
from spatial.tilting_scenes import spatial
from tiers import first

from planetary_twin_py import SceneError, Twin, load_scene, simulate
from planetary_twin_py.checks.accuracy import course_warnings
from planetary_twin_py.run.start import start
from planetary_twin_py.statics.load_sharing import load_sharing

RATTLE = {"input_torque": 0.3, "torque_ripple": 3.0}
PIN = {"errors.pin_tangential": [-2e-5, 0.0, 0.0]}


def imbalance(scene, tolerance, **options):
    energy = simulate(scene, 0.03, tolerance=tolerance, **options).energy
    return abs(energy.residual) / energy.driving_work


@pytest.mark.parametrize("flow", FLOWS + DIFFERENTIALS, ids=flow_name)
def test_energy_balances_whatever_is_held_and_driven(flow):
    assert imbalance(planar(flow), 1e-5) < 1e-6


@pytest.mark.parametrize("flow", [FLOWS[3], FLOWS[4]], ids=flow_name)
@pytest.mark.parametrize("slew", first(1, [500.0, -500.0]))
def test_energy_balances_while_a_fast_carrier_changes_speed(flow, slew):
    # The centrifugal force displaces planets by 0.2 mm, 1 % of their distance from the centre.
    scene = planar(flow, {"bearing": 1e8}).replace(
        **{
            "supports.planet.mass": 1.5,
            "gearset.planet_mass": 1.5,
            "drive.speed_limit": 2600.0,
            "drive.speed_control.start_speed": 1000.0,
            "drive.speed_control.slew_rate": abs(slew),
            "input_speed": 1000.0 + 0.1 * slew,
            "input_torque": 400.0,  # with less, the flanks rattle, and each impact adds its error
        }
    )
    run = simulate(scene, 0.03, tolerance=1e-5)
    assert abs(run.energy.kinetic) > 0.05 * run.energy.driving_work
    assert abs(run.axes.displacement[:, 3:]).max() > 1e-4
    assert abs(run.energy.residual) < 2e-6 * sum(map(abs, run.energy.machines))


@pytest.mark.parametrize(
    "changes",
    [
        RATTLE,
        PIN | {"backlash": 2e-7},
        PIN | {"supports.sun.clearance": 1e-5},
        {"supports.planet.clearance": 5e-6, "input_torque": 5.0, "torque_ripple": 8.0},
        {"supports.sun.bearing": 0.0, "mesh.runout.sun": 8e-6, "mesh.runout.planet": 4e-6},
        {"mesh.ramp": 0.0, "lubrication.friction": False},
        {"lubrication.rolling": "goksem_hargreaves"},
        {"input_torque": -63.0},
    ],
    ids=str,
)
@pytest.mark.parametrize("flow", first(1, [FLOWS[2], FLOWS[0]]), ids=flow_name)
def test_energy_balances_with_gaps_errors_and_both_flanks(flow, changes):
    given = dict(changes)
    if "input_torque" in given and flow == FLOWS[2] and given["input_torque"] == -63.0:
        given["input_speed"] = -100.0
    assert imbalance(planar(flow, **given), 1e-5) < 1e-6


@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[2], FLOWS[3]], ids=flow_name)
def test_mean_torques_of_sun_ring_and_carrier_add_up_to_nothing(flow):
    scene = planar(flow, **PIN, **{"lubrication.friction": False})
    run = simulate(scene, 0.1, tolerance=1e-5, settling=0.05)
    gears = load_scene("paper").gearset.geometry
    net = run.mesh["mesh_force_mean"]
    sun, ring = net[:3].sum() * gears.sun.base_radius, net[3:].sum() * gears.ring.base_radius
    pins = run.axes.bearing_force[:, 3:, 1].sum(axis=1).mean() * gears.centre_distance
    # Of that, what holds the planets beside their radius against centrifugal forces is the frame's.
    beside = run.axes.displacement[:, 3:, 1].sum(axis=1).mean() * gears.centre_distance
    pins -= MASSES["planet"] * run.mean_speed[-1] ** 2 * beside
    assert abs(pins - sun - ring) < 1e-5 * abs(pins)


@pytest.mark.parametrize("planets", [3, 4, 5])
@pytest.mark.parametrize("sun", [1e8, 0.0])
def test_mean_loads_are_shared_as_in_statics(planets, sun):
    errors = [-1e-5] + [0.0] * (planets - 1)
    scene = planar(
        FLOWS[0],
        {"sun": sun},
        **{
            "gearset.planet_angles": evenly(planets),
            "errors.pin_tangential": errors,
            "mesh.double_pair_ratio": 1.0,
            "mesh.ramp": 0.0,
            "lubrication.friction": False,
        },
    )
    static = load_sharing(scene)
    expected = static.share.mean(axis=0)
    run = simulate(scene, 0.02, settling=0.03)
    forces = run.mesh["mesh_force_mean"][:planets]
    assert forces / forces.mean() == pytest.approx(expected, rel=5e-3)
    assert run.axes.mean_load_share == pytest.approx(expected, rel=5e-3)
    bearings = np.concatenate([static.bearing, static.planet_bearing], axis=1).mean(axis=0)
    assert run.axes.bearing_force.mean(axis=0) == pytest.approx(bearings, rel=5e-3, abs=2.0)
    moved = static.displacement.mean(axis=0)
    assert run.axes.displacement[:, :3].mean(axis=0) == pytest.approx(moved, rel=5e-3, abs=2e-8)


def test_windows_that_repeat_mesh_cycles_have_samples_of_a_run():
    scene = load_scene("floating_sun")
    run = simulate(scene, 2.0, 1000.0, tolerance=1e-3)
    twin = Twin(scene, tolerance=1e-3, sample_rate=1000.0)
    windows = [twin.advance(0.05) for _ in range(40)]
    assert run.stats.repeated_steps > 0 and windows[-1].repeated
    for field in ("displacement", "bearing_force", "orbit", "flank_force"):
        shown = np.concatenate([getattr(window.axes, field) for window in windows])
        assert (shown == getattr(run.axes, field)).all(), field


@pytest.mark.parametrize(
    "scene",
    [planar(FLOWS[2], **RATTLE, **PIN, **{"supports.gravity": 9.81}), spatial(FLOWS[2])],
    ids=["planar", "spatial"],
)
def test_windows_of_any_length_give_the_same_samples(scene):
    whole, twin = Twin(scene).advance(0.01), Twin(scene)
    parts = [twin.advance(length) for length in (0.0013, 0.0047, 0.004)]

    def assert_joined(of, names):
        for name in names:
            pieces = np.concatenate([getattr(of(part), name) for part in parts])
            assert (pieces == getattr(of(whole), name)).all(), name

    assert_joined(lambda window: window.waveform, ("dte", "mesh_force", "friction"))
    assert_joined(lambda window: window.axes, ("displacement", "bearing_force", "orbit"))
    if whole.axes.tilting is not None:
        names = ("axial_displacement", "tilt", "axial_force", "tilting_moment")
        assert_joined(lambda window: window.axes.tilting, names)


def test_renumbered_planets_are_the_same_planets():
    scene = planar(FLOWS[0], **PIN)
    order = [2, 0, 1]
    angles = [scene.gearset.planet_angles[i] for i in order]
    errors = [scene.errors.pin_tangential[i] for i in order]
    other = scene.replace(**{"gearset.planet_angles": angles, "errors.pin_tangential": errors})
    # Phases of meshes count from the first planet: compare what does not depend on the time.
    one, same = (simulate(each, 0.02, settling=0.03) for each in (scene, other))
    mean = one.mesh["mesh_force_mean"].reshape(2, 3)[:, order].ravel()
    assert same.mesh["mesh_force_mean"] == pytest.approx(mean, rel=1e-4)
    rms = one.mesh["dte_rms"].reshape(2, 3)[:, order].ravel()
    assert same.mesh["dte_rms"] == pytest.approx(rms, rel=2e-3)


def test_both_flanks_of_a_wedged_mesh_carry_as_in_statics():
    scene = planar(
        FLOWS[0],
        {"sun": 0.0},
        **PIN,
        **{
            "backlash": 2e-7,
            "mesh.double_pair_ratio": 1.0,
            "mesh.ramp": 0.0,
            "lubrication.friction": False,
        },
    )
    static = load_sharing(scene).mesh_force.mean(axis=0)
    assert static[1].max() > 100.0
    run = simulate(scene, 0.01, settling=0.03)
    assert run.axes.flank_force.mean(axis=0) == pytest.approx(static, rel=2e-3, abs=1.0)


@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[2]], ids=flow_name)
def test_torque_that_turns_round_crosses_backlash_on_moving_axes(flow):
    twin = Twin(planar(flow))
    torque = twin.scene.operating_point.input_torque
    twin.advance(0.01)
    twin.set(input_torque=-torque)
    twin.advance(0.04)
    window = twin.advance(0.02)
    assert (window.mesh["mesh_force_mean"] * torque < 0.0).all()
    assert abs(window.residual_power) < 1e-5 * abs(window.input_power)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"supports": None}, "supports: missing; with dynamics = 'planar'"),
        ({"supports.sun.torsion": 1e6}, "supports.sun.torsion = 1000000.0: must be 0"),
        ({"lubrication.friction_torque": "printed"}, "must be 'sliding' with dynamics = 'planar'"),
        ({"mesh.backlash": "regulatory_factor"}, "must be 'dead_zone' with dynamics = 'planar'"),
    ],
)
def test_what_moving_axes_do_not_hold_is_refused_in_one_line(changes, said):
    with pytest.raises(SceneError, match=re.escape(said)):
        planar(**changes)


def test_a_free_sun_follows_an_offset_of_the_ring_as_in_statics():
    given = planar(FLOWS[0], {"sun": 0.0}, **{"errors.ring_offset": {"size": 1e-5}})
    static, run = load_sharing(given), simulate(given, 0.01, settling=0.03)
    moved = static.displacement.mean(axis=0)
    assert run.axes.displacement[:, :3].mean(axis=0) == pytest.approx(moved, rel=2e-2, abs=1e-7)


def test_a_scene_with_supports_runs_in_torsion_as_without():
    scene = load_scene("floating_sun").replace(dynamics="torsional")
    one, other = (simulate(each, 0.005) for each in (scene, scene.replace(supports=None)))
    assert one.axes is None
    assert (one.dte == other.dte).all()


FLOATING = {
    "dynamics": "planar",
    "gearset.held": "ring",
    "drive.output.member": "carrier",
    "supports.planet": {
        "mass": 0.177, "bearing": None, "rolling": {"rollers": 14, "length": 0.012}
    },
}  # fmt: skip
GAPS = {
    "pin_tangential": (-23.4e-6, 24.0e-6, -12.3e-6, -13.2e-6, -21.3e-6),
    "planet_thickness": (-8.8e-6, -2.4e-6, -1.1e-6, -3.7e-6, -9.9e-6),
}


@pytest.mark.filterwarnings("ignore:flanks engage")
@pytest.mark.parametrize(
    "scene",
    [
        # Two opposite planets alone carry load, and the sun floats between flanks of the others.
        load_scene("floating_sun").replace(**FLOATING, input_torque=30.0),
        load_scene("floating_sun").replace(**FLOATING, input_torque=5.0),
        # Five planets with gaps on all sides under next to no load.
        published(
            5, GAPS, dynamics="planar", input_torque=0.1, **{"supports.planet.clearance": 5e-6}
        ),
    ],
    ids=["two planets", "two planets with less load", "gaps on all sides"],
)
def test_a_run_starts_in_the_equilibrium_of_statics(scene):
    assert start(scene, 1e-4).start_warning == ""
    sun = simulate(scene, 1e-6, sample_rate=1e6).mesh_force[0, : scene.gearset.planets]
    static = load_sharing(scene, np.array([0.0]))
    # Friction and damping add some thousandths to shares of statics.
    assert sun / sun.mean() == pytest.approx(static.share[0], abs=5e-3)


def test_a_start_without_equilibrium_names_what_is_left(monkeypatch):
    steady = published(5, dynamics="planar")
    assert start(steady, 1e-4).start_warning == ""
    monkeypatch.setattr("planetary_twin_py.model.start.UNBALANCED", 0.0)  # what rounding leaves
    said = start(steady, 1e-4).start_warning
    assert re.fullmatch(r"no static equilibrium .* a force of \S+ N on \w+(\.\w+)? is not .*", said)
    twin = Twin(steady)
    assert said in course_warnings(twin.advance(1e-4).course)
    assert said not in course_warnings(twin.advance(1e-4).course)
