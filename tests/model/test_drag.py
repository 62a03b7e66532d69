"""Bearings and churning in a running gearbox: booked, dissipative, and felt by the load."""

import math

import numpy as np
import pytest
from planetary_twin_core_parts import SLOWEST_TURN, apply_drag
from power_flows import ALL_FLOWS, FLOWS, scene_of

import planetary_twin_py as pt
from planetary_twin_py._core import BEARING, BODIES, Evaluation
from planetary_twin_py.run.engine import Engine

LOSSES = {
    "planet_bearing": {"mean_diameter": "10 mm", "f0": 8.0, "f1": 1e-3},
    "sun_bearing": {"mean_diameter": "25 mm"},
    "ring_bearing": {"mean_diameter": "60 mm"},
    "churning": {"fill": 0.3, "gap": "5 mm", "ring": "32 mm", "carrier": "25 mm"},
}


@ALL_FLOWS
def test_balance_closes_with_drag_whatever_is_held(flow):
    run = pt.simulate(scene_of(flow, losses=LOSSES), 0.05, tolerance=1e-5)
    energy = run.energy
    assert energy.bearing > 0.0 and energy.churning > 0.0
    assert abs(energy.residual) < 1e-6 * energy.driving_work
    assert run.total_power_loss.mean() == pytest.approx(energy.loss / 0.05, rel=5e-3)
    assert (run.bearing_loss >= 0.0).all() and (run.churning_loss >= 0.0).all()


def test_loss_of_planet_bearings_follows_palmgren_at_pin_load():
    """1500 rpm of the planets, 2 * 1750 N on each pin, nu 89.9 mm^2/s at 70 deg C."""
    only = {"planet_bearing": LOSSES["planet_bearing"]}
    run = pt.simulate(scene_of(FLOWS[0], losses=only), 0.1)
    idle = 1e-7 * 8.0 * (89.888 * 1500.0) ** (2 / 3) * 10.0**3
    friction_force = 1e-3 * 2 * 1750.0 * 10.0
    expected = 3 * (idle + friction_force) * 1e-3 * 1500.0 * math.pi / 30
    assert run.bearing_loss[run.time > 0.02].mean() == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize(("sides", "load"), [((1, 1), 700.0), ((-1, -1), 700.0), ((1, -1), 100.0)])
def test_a_pin_carries_what_both_meshes_of_its_planet_leave_it(sides, load):
    """400 N from the sun and 300 N from the ring: against one another where flanks differ."""
    rough = {"planet_bearing": {"mean_diameter": "10 mm", "f0": 0.0, "f1": 1e-3}}
    engine, out = Engine(scene_of(FLOWS[0], losses=rough), 1e-3), Evaluation()
    state, train = engine.integrator.end, engine.train
    planets = train.meshes // 2
    for k, (side, push) in enumerate(zip(sides, (400.0, 300.0), strict=True)):
        state.side[k * planets : (k + 1) * planets] = side
        out.now.normal_force[k * planets : (k + 1) * planets] = push / math.cos(math.radians(21.34))
    apply_drag(engine.model, state, np.zeros(BODIES), out)
    torque = 3 * 1e-3 * load * 0.010
    assert out.power[BEARING] == pytest.approx(torque * 1500.0 * math.pi / 30, rel=1e-6)


def test_losses_lower_the_efficiency_by_their_share():
    bare, lossy = (pt.simulate(scene_of(FLOWS[0], **c), 0.1) for c in ({}, {"losses": LOSSES}))
    more = (lossy.energy.bearing + lossy.energy.churning) / lossy.energy.driving_work
    assert bare.efficiency - lossy.efficiency == pytest.approx(more, abs=2e-5)
    assert lossy.mesh_efficiency == pytest.approx(bare.mesh_efficiency, abs=2e-5)


def test_a_run_with_losses_begins_steady():
    twin = pt.Twin(scene_of(FLOWS[0], losses=LOSSES))
    speeds = [twin.advance(0.02).input_speed for _ in range(10)]
    assert speeds[-1] == pytest.approx(pt.rpm(1000), rel=2e-3)
    assert np.ptp(speeds) < 0.01 * pt.rpm(1000)


@pytest.mark.parametrize("dynamics", ["torsional", "quasi_static"])
@ALL_FLOWS
def test_drag_takes_coulomb_and_viscous_torque_times_speed(flow, dynamics):
    member, coulomb, viscous = scene_of(flow).drive.output.member, 0.3, 2e-3
    losses = {f"{member}_drag": {"coulomb": coulomb, "viscous": viscous}}
    run = pt.simulate(scene_of(flow, losses=losses, dynamics=dynamics), 0.05, tolerance=1e-5)
    speed = run.speed[:, run.bodies.index(member)]
    expected = coulomb * np.abs(speed) + viscous * speed**2
    assert run.bearing_loss == pytest.approx(expected, rel=1e-6)
    # The ledger is that of whole steps: it ends up to a step behind the last sample.
    assert run.energy.bearing == pytest.approx(0.05 * expected.mean(), rel=5e-3)
    assert abs(run.energy.residual) < 1e-6 * run.energy.driving_work


def test_drag_passes_through_standstill_as_bearings_do():
    """Half of it at 0.577 of the speed at which it fades, none at rest, reversed beyond."""
    losses = {"sun_drag": {"coulomb": 0.3}}
    found = []
    for speed in (-50.0, -SLOWEST_TURN / math.sqrt(3.0), 0.0, SLOWEST_TURN / math.sqrt(3.0), 50.0):
        engine = Engine(scene_of(FLOWS[0], losses=losses, input_speed=speed), 1e-3)
        out, train = Evaluation(), engine.train
        apply_drag(engine.model, engine.integrator.end, np.zeros(BODIES), out)
        found.append(float(out.friction_force[train.sun] * train.body.radius[train.sun]))
    assert found == pytest.approx([0.3, 0.15, 0.0, -0.15, -0.3], rel=1e-6)


@pytest.mark.filterwarnings("ignore::planetary_twin_py.text.warning_types.AccuracyWarning")
@pytest.mark.parametrize("speed", [0.0, 1.0])
def test_drag_of_a_light_member_does_not_shorten_steps(speed):
    """0.1 N m that reverses within 0.01 rad/s stops 6.6e-8 kg m^2 within 7 ns."""
    scene = pt.load_scene("compact_actuator").replace(
        **{"dynamics": "torsional", "input_speed": speed, "input_torque": 0.05,
           "lubrication.boundary_coefficient": 0.3}
    )  # fmt: skip
    coarse, fine = (pt.simulate(scene, 0.005, tolerance=t) for t in (1e-4, 1e-6))
    assert coarse.stats.steps + coarse.stats.rejected_steps < 3000
    assert coarse.energy.bearing == pytest.approx(fine.energy.bearing, rel=1e-3, abs=1e-12)
    assert abs(coarse.energy.residual) < 1e-6 * fine.energy.driving_work + 1e-15
    assert coarse.mesh["dte_mean"] == pytest.approx(fine.mesh["dte_mean"], rel=1e-3)
