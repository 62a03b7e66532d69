"""Weight of the bodies against closed forms, statics and the balances of force and energy."""

import math

import numpy as np
import pytest
from planar.moving_scenes import MASSES, evenly, planar
from power_flows import DIFFERENTIALS, FLOWS, flow_name
from tiers import first

from planetary_twin_py import simulate
from planetary_twin_py.statics.load_sharing import load_sharing

G = 9.81
HEAVY = {"supports.gravity": G}
SMOOTH = {"mesh.double_pair_ratio": 1.0, "mesh.ramp": 0.0, "lubrication.friction": False}
PIN = {"errors.pin_tangential": [-2e-5, 0.0, 0.0]}
TOTAL = MASSES["sun"] + MASSES["ring"] + MASSES["carrier"] + 3.0 * MASSES["planet"]


def in_housing(run, vectors):
    """Vectors of sun, ring and carrier as complex numbers in the housing."""
    return vectors[:, :3] @ np.array([1.0, 1.0j]) * np.exp(1j * run.angle[:, -1:])


@pytest.mark.parametrize("direction", [-0.5 * math.pi, 0.3])
def test_without_a_load_every_body_hangs_in_its_bearing(direction):
    scene = planar(
        FLOWS[0],
        **SMOOTH,
        **{"input_torque": 0.0, "supports.gravity": 10.0, "supports.gravity_direction": direction},
    )
    run = simulate(scene, 0.005, settling=0.05)
    down = np.exp(1j * direction)
    moved = run.axes.displacement.mean(axis=0) @ np.array([1.0, 1.0j])
    for body in (0, 1):  # sun and ring, which hold nothing else
        name = run.axes.bodies[body]
        assert moved[body] == pytest.approx(10.0 * MASSES[name] / 1e8 * down, rel=1e-4)
    carried = MASSES["carrier"] + 3.0 * MASSES["planet"]
    assert moved[2] == pytest.approx(10.0 * carried / 1e8 * down, rel=1e-4)
    pins = run.axes.bearing_force[:, 3:].mean(axis=0) @ np.array([1.0, 1.0j])
    turned = pins * np.exp(1j * np.array(scene.gearset.planet_angles))
    assert turned == pytest.approx(np.full(3, 10.0 * MASSES["planet"] * down), rel=1e-4)


@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[2], FLOWS[3]], ids=flow_name)
def test_the_housing_bears_the_weight_of_everything(flow):
    scene = planar(flow, **HEAVY, **PIN)
    turn = 60.0 / 1000.0 / (0.3 if flow == FLOWS[2] else 1.0)  # of the carrier, if it turns
    run = simulate(scene, turn, settling=0.05)
    total = in_housing(run, run.axes.bearing_force).sum(axis=1).mean()
    assert total == pytest.approx(-1j * G * TOTAL, rel=2e-3)


def test_mean_loads_in_the_housing_do_not_depend_on_duration():
    """The weight of the ring turns in the frame of the carrier."""
    changes = {**SMOOTH, "input_torque": 0.0, "dynamics": "quasi_static_planar"}
    scene = planar(FLOWS[3], **HEAVY, **changes)
    short = simulate(scene, 0.001)
    turn = 2.0 * math.pi / abs(short.mean_speed[short.bodies.index("carrier")])
    found = [simulate(scene, share * turn).axes.statistics for share in (0.3, 1.0)]
    weight = G * MASSES["ring"]
    for each in found:
        assert each.bearing_force_magnitude[1] == pytest.approx(weight, rel=5e-3)
        assert each.displacement_magnitude[1] == pytest.approx(weight / 1e8, rel=5e-3)
    assert np.linalg.norm(found[1].bearing_force_mean[1]) < 0.01 * weight


@pytest.mark.parametrize("flow", first(5, FLOWS + DIFFERENTIALS), ids=flow_name)
@pytest.mark.parametrize("uneven", first(1, [True, False]))
def test_energy_balances_with_weight(flow, uneven):
    angles = {"gearset.planet_angles": evenly(5)[:3]} if uneven else {}
    scene = planar(flow, {"sun": 0.0 if uneven else 1e8}, **HEAVY, **angles)
    energy = simulate(scene, 0.05, tolerance=1e-5).energy
    assert abs(energy.residual) < 1e-6 * energy.driving_work


def test_the_ledger_counts_the_height_of_uneven_planets():
    """Planets on one side are lifted and lowered by the carrier, through the motor."""
    # Without torque, so that springs store little, and without backlash, as rattle stores energy.
    changes = {"gearset.planet_angles": evenly(5)[:3], "input_torque": 0.0, "backlash": 0.0}
    light = planar(FLOWS[3], **SMOOTH, **changes)
    heavy = light.replace(**{"supports.gravity": 100.0})
    half = 0.5 * 60.0 / 1000.0  # of a turn, nearly
    one, other = runs = [simulate(scene, half, tolerance=1e-6) for scene in (light, heavy)]
    arm = light.gearset.geometry.centre_distance
    place = arm * sum(np.exp(1j * angle) for angle in light.gearset.planet_angles)
    # The motor yields to the weight, which acts along -y.
    lifted = [
        scene.supports.gravity * MASSES["planet"] * (place * (np.exp(1j * turned) - 1.0)).imag
        for scene, run in zip((light, heavy), runs, strict=True)
        for turned in [run.angle[-1, run.bodies.index("carrier")]]
    ]
    gained = other.energy.elastic - one.energy.elastic
    assert gained == pytest.approx(lifted[1] - lifted[0], rel=1e-3)
    assert abs(lifted[1]) > 1.0


@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[2]], ids=flow_name)
def test_bearing_forces_of_the_weight_follow_statics(flow):
    light = planar(flow, **SMOOTH, **PIN)
    heavy = light.replace(**{"supports.gravity": 100.0})
    runs = [simulate(scene, 0.05, sample_rate=1000.0, settling=0.1) for scene in (light, heavy)]
    turns = runs[0].angle[:, 0] / (2.0 * math.pi)  # of the sun, the motor
    statics = [load_sharing(scene, turns) for scene in (light, heavy)]
    expected = np.concatenate(
        [statics[1].bearing - statics[0].bearing,
         statics[1].planet_bearing - statics[0].planet_bearing], axis=1,
    )  # fmt: skip
    found = runs[1].axes.bearing_force - runs[0].axes.bearing_force
    assert np.abs(found - expected).max() < 0.02 * np.abs(expected).max()
    if flow == FLOWS[2]:  # the carrier turns, so the weight turns in its frame
        assert np.ptp(np.unwrap(np.angle(expected[:, 2] @ np.array([1.0, 1.0j])))) > 1.0
