"""Quasi-static runs with axes that move, against statics, held axes, dynamics and balances."""

import math

import numpy as np
import pytest
from planar.moving_scenes import evenly, planar
from planar.published_set import scene
from power_flows import ALL_FLOWS, FLOWS, flow_name
from quasi_static.steady_drive import STEADY
from spatial.tilting_scenes import spatial

from planetary_twin_py import Twin, load_scene, simulate
from planetary_twin_py.statics.load_sharing import load_sharing

STILL = {"dynamics": "quasi_static_planar"}
CONSTANT = {"mesh.double_pair_ratio": 1.0, "mesh.ramp": 0.0, "lubrication.friction": False}
SMOOTH = {"lubrication.friction": False}
PIN = {"errors.pin_tangential": [-2e-5, 0.0, 0.0]}


def imbalance(given, duration=0.02, **options):
    energy = simulate(given, duration, **options).energy
    return abs(energy.residual) / energy.driving_work


@ALL_FLOWS
def test_energy_closes_whatever_is_held(flow):
    assert imbalance(planar(flow, **STILL)) < 1e-12


@pytest.mark.parametrize(
    "changes",
    [
        PIN | {"backlash": 2e-7, "supports.sun.bearing": 0.0},
        PIN | {"supports.sun.clearance": 1e-5, "supports.planet.clearance": 5e-6},
        {"mesh.runout.sun": 8e-6, "mesh.runout.planet": 4e-6},
        {"faults": [{"kind": "wear", "gear": "sun", "tooth": 7, "depth": "4 um"}]},
        {"input_torque": 0.5, "losses.planet_bearing": {"mean_diameter": 0.01, "f0": 8.0}},
        {"input_torque": 20.0, "torque_ripple": 40.0},
    ],
    ids=str,
)
@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[2]], ids=flow_name)
def test_energy_closes_with_errors_gaps_faults_and_little_load(flow, changes):
    assert imbalance(planar(flow, **STILL, **changes)) < 1e-12


def loose(flow, torque, speed, **more):
    clearance = {"supports.planet.clearance": 2e-5}
    point = {"input_torque": torque, "input_speed": speed, "drive.speed_limit": 2.0 * speed}
    return planar(flow, **STILL, **clearance, **point, **more)


@pytest.mark.parametrize("speed", [50.0, 800.0])
@pytest.mark.parametrize("torque", [2.0, 20.0])
@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[2]], ids=flow_name)
def test_loose_planets_find_an_equilibrium_with_friction(flow, torque, speed):
    assert imbalance(loose(flow, torque, speed), 0.01) < 1e-12


@pytest.mark.parametrize("speed", [50.0, 800.0])
@pytest.mark.parametrize("torque", [2.0, 20.0])
@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[2]], ids=flow_name)
def test_loose_planets_carry_as_in_static_load_sharing(flow, torque, speed):
    given = loose(flow, torque, speed, **CONSTANT)
    static = load_sharing(given).mesh_force[0]
    found = simulate(given, 0.001).axes.flank_force
    assert found == pytest.approx(np.broadcast_to(static, found.shape), rel=1e-4, abs=0.01)


def test_weight_on_a_turning_carrier_gives_back_what_it_takes():
    given = planar(FLOWS[2], **STILL, **{"supports.gravity": 9.81, "input_torque": 2.0}, **PIN)
    assert imbalance(given, 0.2) < 1e-6


@pytest.mark.parametrize("sun", [0.0, 1e8])
@pytest.mark.parametrize("planets", [3, 4, 5])
def test_shares_are_those_of_static_load_sharing(planets, sun):
    errors = {"pin_tangential": [-1e-5] + [0.0] * (planets - 1)}
    given = scene(planets, errors, sun, evenly(planets), **CONSTANT, **STILL)
    static, run = load_sharing(given), simulate(given, 0.001)
    assert run.axes.load_share == pytest.approx(
        np.broadcast_to(static.share[0], run.axes.load_share.shape), rel=1e-6
    )
    bearings = np.concatenate([static.bearing, static.planet_bearing], axis=1)[0]
    found = run.axes.bearing_force
    assert found == pytest.approx(np.broadcast_to(bearings, found.shape), rel=1e-5, abs=0.01)
    moved = run.axes.displacement[:, :3]
    expected = np.broadcast_to(static.displacement[0], moved.shape)
    assert moved == pytest.approx(expected, rel=1e-5, abs=1e-11)


@pytest.mark.parametrize(
    "changes",
    [
        {"backlash": 2e-7},
        {"supports.sun.clearance": 5e-6, "supports.sun.bearing": 1e8},
        {"supports.sun": {"mass": 1.0, "rolling": {"balls": 9, "diameter": 8e-3}}},
        {"supports.planet": {"mass": 1.0, "rolling": {"rollers": 14, "length": 0.012},
                             "clearance": 1e-5}},
    ],
    ids=["both flanks", "clearance", "balls", "rollers with clearance"],
)  # fmt: skip
def test_unilateral_contacts_carry_as_in_static_load_sharing(changes):
    paper = list(load_scene("paper").gearset.planet_angles)
    errors = {"pin_tangential": [0.0, -2e-5, 0.0]}
    given = scene(3, errors, 0.0, paper, **CONSTANT, **STILL).replace(**changes)
    static = load_sharing(given).mesh_force[0]
    found = simulate(given, 0.001).axes.flank_force
    assert (static[1].max() > 100.0) == ("backlash" in changes)
    assert found == pytest.approx(np.broadcast_to(static, found.shape), rel=1e-5, abs=0.01)


@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[3]], ids=flow_name)
def test_very_stiff_bearings_leave_the_statics_of_held_axes(flow):
    moving = planar(flow, {"bearing": 1e13}, **STILL)
    held = moving.replace(dynamics="quasi_static", supports=None)
    one, other = (simulate(each, 0.02) for each in (moving, held))
    scale = np.abs(other.dte).max()
    assert np.abs(one.dte - other.dte).max() < 1e-4 * scale
    assert one.mesh_force == pytest.approx(other.mesh_force, rel=1e-3, abs=0.1)
    assert one.energy.loss == pytest.approx(other.energy.loss, rel=1e-4)


@pytest.mark.parametrize("build", [planar, spatial])
def test_dynamics_tends_to_statics_as_the_speed_falls(build):
    """Without friction, which makes axes ring where it reverses, at any speed."""
    differences = []
    for speed in (8.0, 2.0):
        given = build(FLOWS[0], **PIN, **STEADY, **SMOOTH, input_speed=speed)
        cycle = 2.0 * math.pi / (30.0 * speed)
        runs = [
            simulate(each, 2 * cycle, 400.0 / cycle, settling=4 * cycle, tolerance=1e-5)
            for each in (given, given.replace(dynamics=f"quasi_static_{given.dynamics}"))
        ]
        force, displacement = (
            [getattr(run.axes, name) for run in runs] for name in ("bearing_force", "displacement")
        )
        gaps = []
        for moving, still in (force, displacement):
            gaps.append(math.sqrt(((moving - still) ** 2).mean() / (still**2).mean()))
        differences.append(gaps)
    assert max(differences[1]) < 0.01
    assert all(slow < 0.6 * fast for fast, slow in zip(*differences, strict=True))


def test_windows_of_a_twin_show_what_a_run_shows():
    given = planar(FLOWS[2], **STILL, **PIN)
    run = simulate(given, 0.01, tolerance=1e-6)
    twin = Twin(given, tolerance=1e-6)
    windows = [twin.advance(length) for length in (0.003, 0.007)]
    for name in ("dte", "mesh_force"):
        pieces = np.concatenate([getattr(each.waveform, name) for each in windows])
        assert pieces == pytest.approx(getattr(run, name), rel=1e-5, abs=1e-12)
    for name in ("displacement", "bearing_force", "orbit", "flank_force"):
        pieces = np.concatenate([getattr(each.axes, name) for each in windows])
        scale = np.abs(getattr(run.axes, name)).max()
        assert pieces == pytest.approx(getattr(run.axes, name), abs=1e-5 * scale)
    assert windows[1].axes.mean_load_share == pytest.approx(run.axes.mean_load_share, rel=1e-3)


@pytest.mark.parametrize("error", [0.0, -20e-6, -200e-6])
def test_a_planet_is_displaced_without_the_error_of_its_pin(error):
    """Force over stiffness is displacement less error of the pin and motion of the carrier."""
    changes = {"errors.pin_tangential": [error, 0.0, 0.0, 0.0]}
    scene = load_scene("floating_sun").replace(dynamics="quasi_static_planar", **changes)
    axes = simulate(scene, 0.002, 2000.0).axes
    planet, carrier = (axes.bodies.index(name) for name in ("planet_1", "carrier"))
    angle = scene.gearset.planet_angles[0]
    across = np.array([-np.sin(angle), np.cos(angle)])
    of_carrier = axes.displacement[:, carrier] @ across
    bent = axes.bearing_force[:, planet, 1] / scene.supports.planet.bearing
    assert axes.displacement[:, planet, 1] - error - of_carrier == pytest.approx(bent, abs=1e-11)


FAST = {"input_speed": 1500.0, "drive.speed_limit": 2000.0, **CONSTANT, **STILL}
ROLLERS = {"mass": 0.177, "rolling": {"rollers": 14, "length": 0.02}}


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"errors": {"pin_tangential": [2e-5, 0.0, 0.0], "pin_radial": [0.0, 3e-5, 0.0]}},
        {"supports.planet": ROLLERS | {"clearance": 1e-5}},
        {"supports.planet.clearance": 1e-5, "supports.sun.bearing": 0.0},
    ],
    ids=["equal planets", "errors", "rollers with clearance", "clearance and floating sun"],
)
@pytest.mark.parametrize("flow", [FLOWS[2], FLOWS[5]], ids=flow_name)
def test_pin_loads_at_speed_have_the_centrifugal_forces(flow, changes):
    # Where the carrier turns, damping acts on displacements in the housing.
    undamped = {f"supports.{body}.damping": 0.0 for body in ("sun", "ring", "carrier")}
    given = planar(flow, **FAST).replace(**changes, **undamped)
    run = simulate(given, 0.002, tolerance=1e-7)
    turns = run.time[::10] * given.operating_point.input_speed / (2.0 * math.pi)
    found = load_sharing(given, turns)
    static = np.concatenate([found.bearing, found.planet_bearing], axis=1)
    largest = np.abs(static).max()
    assert run.axes.bearing_force[::10] == pytest.approx(static, abs=2e-6 * largest)
    slow = load_sharing(given.replace(input_speed=1.0), turns)
    outwards = found.planet_bearing[:, :, 0] - slow.planet_bearing[:, :, 0]
    carrier = run.speed[0, run.bodies.index("carrier")]
    arm = given.gearset.geometry.centre_distance
    assert outwards == pytest.approx(0.177 * carrier**2 * arm, rel=0.02)


def test_held_axes_put_the_centrifugal_force_on_the_pins():
    given = planar(FLOWS[2], **FAST).replace(dynamics="quasi_static", supports=None)
    still = load_sharing(given.replace(input_speed=0.0)).planet_bearing
    carrier = 1500.0 * 30 / 100  # [rad/s]
    force = 0.177 * carrier**2 * given.gearset.geometry.centre_distance
    fast = load_sharing(given).planet_bearing
    assert fast[:, :, 0] - still[:, :, 0] == pytest.approx(force, rel=1e-9)
    assert fast[:, :, 1] == pytest.approx(still[:, :, 1])


def test_a_loose_carrier_and_sun_have_an_equilibrium_at_speed():
    """Both are pressed outwards, so their places in the middle of the clearance are unstable."""
    loose = {f"supports.{body}.clearance": 1e-5 for body in ("sun", "carrier", "planet")}
    given = planar(FLOWS[2], **FAST).replace(**loose)
    found = load_sharing(given)
    assert np.isfinite(found.bearing).all()
    assert np.abs(found.planet_bearing[:, :, 0]).min() > 0.9 * 0.177 * 450.0**2 * 0.02
