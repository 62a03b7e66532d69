"""Quasi-static runs: motion, ledger, changes, and the dynamic model at low speed."""

import math
from fractions import Fraction

import numpy as np
import pytest
from power_flows import ALL_FLOWS, scene_of
from quasi_static.steady_drive import STEADY
from run.test_long_run import HOURS, columns, turns_after

import planetary_twin_py as pt
from planetary_twin_py._core import HEAT
from planetary_twin_py.model.clock import TICKS
from planetary_twin_py.model.layout import Layout
from planetary_twin_py.run.samples import EVERYTHING
from planetary_twin_py.run.window_jobs import run_alone
from planetary_twin_py.run.windows import Windows

PAPER = pt.load_scene("paper").replace(dynamics="quasi_static")
LOSSES = {
    "planet_bearing": {"mean_diameter": "10 mm", "f0": 8.0, "f1": 1e-3},
    "sun_bearing": {"mean_diameter": "25 mm"},
    "churning": {"fill": 0.3, "gap": "5 mm", "ring": "32 mm", "carrier": "25 mm"},
}
ERRORS = {
    "mesh.sun_planet_error": {"amplitudes": ["3 um", "1 um"]},
    "mesh.runout.planet": "4 um",
    "backlash": "3 um",
}
WEAR = {"faults": [{"kind": "wear", "gear": "sun", "tooth": 7, "depth": "4 um"}]}


def closes(energy):
    return abs(energy.residual) <= 1e-12 * energy.driving_work


@ALL_FLOWS
def test_energy_closes_whatever_is_held(flow):
    run = pt.simulate(scene_of(flow, dynamics="quasi_static", losses=LOSSES), 0.05)
    assert closes(run.energy) and run.energy.bearing > 0.0 and run.energy.churning > 0.0
    assert run.total_power_loss.mean() * 0.05 == pytest.approx(run.energy.loss, rel=1e-3)
    assert run.stats.steps == 0


@pytest.mark.parametrize("name", pt.packaged_scenes())
def test_every_packaged_scene_runs(name):
    run = pt.simulate(pt.load_scene(name).replace(dynamics="quasi_static"), 0.02)
    assert closes(run.energy) and np.isfinite(run.dte).all()


@pytest.mark.parametrize("planets", range(2, 8))
def test_any_number_of_planets_runs(planets):
    teeth = {"sun": 42, "planet": 21, "ring": 84}  # 126: planets on multiples of 2 pi/126
    angles = [2 * math.pi / 126 * round(126 * p / planets) for p in range(planets)]
    scene = PAPER.replace(
        **{"gearset.teeth": teeth, "gearset.planet_angles": angles, "gearset.module": 5e-4}
    )
    assert closes(pt.simulate(scene, 0.02).energy)
    smooth = pt.simulate(scene.replace(**{"lubrication.friction": False}), 0.02)
    base = 42 * 5e-4 / 2 * math.cos(scene.gearset.pressure_angle)
    for meshes in (slice(planets), slice(planets, None)):
        forces = smooth.mesh_force[:, meshes].sum(axis=1)
        assert forces == pytest.approx(np.full(1000, 63.0 / base), rel=1e-11)


@pytest.mark.parametrize(
    "changes",
    [{}, ERRORS, WEAR, {"input_torque": -63.0}, {"input_torque": 0.5, **ERRORS}],
    ids=["drive", "errors", "wear", "coast", "light"],
)
def test_dynamics_tends_to_statics_as_the_speed_falls(changes):
    differences = []
    for speed in (80.0, 20.0):
        scene = pt.load_scene("paper").replace(**STEADY, **changes, input_speed=pt.rpm(speed))
        cycle = 60.0 / (30.0 * speed)
        moving = pt.simulate(scene, 12 * cycle, 200.0 / cycle)
        still = pt.simulate(scene.replace(dynamics="quasi_static"), 12 * cycle, 200.0 / cycle)
        late = moving.time > 4 * cycle
        rms = math.sqrt((still.mesh_force[late] ** 2).mean())
        gap = (moving.mesh_force - still.mesh_force)[late]
        differences.append(math.sqrt((gap**2).mean()) / rms)
    assert differences[1] < 0.01
    assert differences[1] < 0.6 * differences[0]


def test_loss_is_that_of_dynamics_but_for_mesh_compliance():
    """Flanks also slide as their mesh yields, which is less the stiffer it is."""
    gaps = []
    for stiffness in (2e8, 2e9):
        stiff = {f"mesh.{m}_stiffness": stiffness for m in ("sun_planet", "planet_ring")}
        scene = pt.load_scene("paper").replace(**STEADY, **stiff, input_speed=pt.rpm(12))
        runs = [
            pt.simulate(scene.replace(dynamics=name), 2.4, 1000.0)
            for name in ("torsional", "quasi_static")
        ]
        late = runs[0].time > 0.8
        loss = [run.total_power_loss[late].mean() for run in runs]
        gaps.append(abs(loss[0] / loss[1] - 1.0))
    assert gaps[0] < 3e-3 and gaps[1] < 0.2 * gaps[0]


def test_angles_are_those_of_rigid_gears_after_hours():
    twin = pt.Twin(PAPER, sample_rate=1.0)
    for _ in range(60):
        window = twin.advance(60.0)
    hour = 1000 * 60  # whole turns of the sun, 3/7 of them back at the ring
    assert window.end == 3600.0
    angle = dict(zip(window.bodies, window.angle, strict=True))
    ring = (-hour * 3 % 7) / 7 * 2 * math.pi
    for body, expected in (("sun", 0.0), ("ring", ring), ("planet_1", 0.0), ("carrier", 0.0)):
        assert abs(math.remainder(angle[body] - expected, 2 * math.pi)) < 1e-9


def aged(scene):
    """A twin whose clock and whole turns are those of HOURS."""
    twin = pt.Twin(scene)
    engine = twin._engine
    for state in (engine._origin, engine._ledger._reached):
        state.seconds += 3600 * HOURS
        state.turns[:1] += turns_after(scene, HOURS)
    twin._windows.ticks += 3600 * HOURS * TICKS
    engine.reached = Fraction(3600 * HOURS)
    twin._windows.begin()
    return twin


@pytest.mark.parametrize("changes", [{}, WEAR, {"torque_ripple": 20.0}], ids=str)
def test_a_thousand_hours_change_no_sample_and_no_power(changes):
    old, young = aged(PAPER.replace(**changes)), pt.Twin(PAPER.replace(**changes))
    for point in ({}, {"input_torque": 40.0}, {"input_speed": 90.0}):
        for twin in (old, young):
            twin.set(**point)
        for length in (0.01, 1e-3, 1.234e-4):
            now, then = old.advance(length), young.advance(length)
            assert np.array_equal(columns(now), columns(then))
            assert np.array_equal(now.machine_power, then.machine_power)
            assert now.power_loss == then.power_loss and now.stored_power == then.stored_power
    assert old.time == 3600 * HOURS + young.time


def advance(windows, until, rate, sampled=True):
    """The window up to `until` [s]."""
    plan = windows.plan(int(until * TICKS), rate, sampled)
    run_alone(windows.jobs(plan))
    windows.close(plan)
    return plan


def test_ledger_of_a_thousand_hours_is_that_of_a_second_as_often():
    second, hours = Windows(PAPER, 1e-4), Windows(PAPER, 1e-4)
    for windows, time in ((second, 1), (hours, 3600 * HOURS)):
        advance(windows, time, 1.0, sampled=False)
    one, all_ = second.last.ledger.copy(), hours.last.ledger.copy()
    assert hours.run.reached == 3600 * HOURS
    assert all_ == pytest.approx(one * 3600 * HOURS, rel=1e-12)
    for windows in (second, hours):
        windows.begin()
        assert not windows.last.ledger[:HEAT].any()


def test_speed_follows_the_set_point_and_inertia_takes_work():
    scene = PAPER.replace(
        **{"drive.speed_control.start_speed": -50.0, "drive.speed_control.slew_rate": 1000.0}
    ).replace(input_speed=50.0)
    run = pt.simulate(scene, 0.2)
    motor = np.minimum(-50.0 + 1000.0 * run.time, 50.0)
    assert run.speed[:, 0] == pytest.approx(motor, abs=1e-9)
    turned = np.where(run.time < 0.1, run.time * (500 * run.time - 50), 50 * (run.time - 0.1))
    assert run.angle[:, 0] == pytest.approx(turned, abs=1e-9)
    assert closes(run.energy)
    assert run.energy.kinetic == pytest.approx(0.0, abs=1e-12)
    # the train turns back first, then forth: by each sample's share of the time
    assert run.total_power_loss.sum() / 50_000 == pytest.approx(run.energy.loss, rel=2e-3)


@pytest.mark.parametrize(
    "changes",
    [WEAR, ERRORS, {"torque_ripple": 20.0}, {"drive.speed_control.start_speed": 20.0}],
    ids=["wear", "errors", "ripple", "ramp"],
)
def test_the_ledger_integrates_motion_that_does_not_repeat(changes):
    """Against the mean of many samples, and at a hundredth of the tolerance."""
    scene = PAPER.replace(**changes)
    run = pt.simulate(scene, 0.05, sample_rate=2e6)
    assert run.energy.friction == pytest.approx(run.power_loss.sum() / 2e6, rel=1e-4)
    fine = pt.simulate(scene, 0.05, 1000.0, tolerance=1e-6)
    assert run.energy.friction == pytest.approx(fine.energy.friction, rel=1e-4)
    assert closes(run.energy)


@pytest.mark.parametrize("changes", [{}, {"torque_ripple": 5.0}])
def test_windows_change_nothing(changes):
    ends = []
    for window, windows in ((0.14, 1), (1e-3, 140), (7e-3, 20)):
        run, parts, taken = Windows(PAPER.replace(**changes), 1e-3, asked=EVERYTHING), [], []
        for n in range(windows):
            plan = advance(run, Fraction(str(window)) * (n + 1), 50_000.0)
            parts.append(np.hstack(plan.waves.mesh))
            taken.append(run.last.ledger[:HEAT].copy())
        sums = [math.fsum(column) for column in zip(*taken, strict=True)]
        sums += list(run.last.ledger[HEAT:])  # which windows do not restart
        ends.append((np.vstack(parts), sums))
    for mesh, ledger in ends[1:]:
        assert np.array_equal(mesh, ends[0][0], equal_nan=True)
        assert ledger == pytest.approx(ends[0][1], rel=1e-12, abs=1e-15)


def test_powers_of_every_window_balance():
    twin = pt.Twin(PAPER)
    for duration in (1e-3, 3.3e-3, 1e-6, 0.5):
        window = twin.advance(duration)
        assert window.input_power == pytest.approx(
            window.output_power + window.power_loss + window.stored_power, rel=1e-6
        )
        assert window.input_torque == pytest.approx(63.0, rel=1e-6)
        assert window.mesh_frequency == pytest.approx(500.0, rel=1e-6)


def test_a_change_holds_from_its_instant():
    twin, run = pt.Twin(PAPER, tolerance=1e-6), pt.simulate(PAPER, 0.04, tolerance=1e-6)
    twin.advance(0.02)
    twin.set(input_torque=-63.0)
    reversed_ = twin.advance(0.01)
    assert (reversed_.waveform.mesh_force < 0.0).all()
    assert (reversed_.waveform.dte < -1e-7).all()
    twin.set(input_torque=63.0)
    again = twin.advance(0.01).waveform
    assert again.mesh_force == pytest.approx(run.mesh_force[-500:], rel=1e-5)


def test_nothing_is_carried_without_load():
    run = pt.simulate(PAPER.replace(input_torque=0.0), 0.02)
    assert (run.mesh_force == 0.0).all() and run.energy.loss == 0.0
    assert np.isnan(run.film_thickness).all() and np.abs(run.dte).max() <= 1e-7


def test_a_force_that_jumps_is_refused_below_its_jump():
    """2e8 N/m times 20 um over cos(phi) is more than 1900 N."""
    jumps = {"mesh.backlash": "regulatory_factor"}
    with pytest.raises(ValueError, match=r"^mesh.backlash = 'regulatory_factor': without dynamics"):
        pt.simulate(PAPER.replace(backlash="20 um", **jumps), 0.01)
    twin = pt.Twin(PAPER.replace(**jumps))
    before = twin.advance(0.01)
    with pytest.raises(ValueError, match=r"mesh.backlash"):
        twin.set(backlash=2e-5)
    after = twin.advance(0.01)
    assert twin.operating_point.backlash == 2e-7 and len(twin.log) == 1
    assert after.power_loss == pytest.approx(before.power_loss, rel=1e-9)


def test_methods_and_tolerances_are_refused_where_there_are_none():
    with pytest.raises(ValueError, match=r"^method = 'rosenbrock': must be auto"):
        pt.simulate(PAPER, 0.01, method="rosenbrock")
    with pytest.raises(ValueError, match=r"^tolerance = 1.0: must be within"):
        pt.simulate(PAPER, 0.01, tolerance=1.0)
    with pytest.raises(pt.SceneError, match=r"^dynamics = 'none'"):
        PAPER.replace(dynamics="none")


def test_ramp_smooths_dte_of_computed_stiffness_as_documented():
    stage = pt.load_scene("reference_gearbox_stage").replace(dynamics="quasi_static")
    cycle = 1.0 / Layout(stage).mesh_frequency
    for ramp, rms, mean in ((0.0, 12.61, 348.6), (0.03, 11.38, 349.8), (0.1, 7.77, 353.3)):
        mesh = pt.simulate(stage.replace(**{"mesh.ramp": ramp}), 4.0 * cycle, 100.0 / cycle).mesh
        assert 1e6 * mesh["dte_rms"].mean() == pytest.approx(rms, abs=0.01)
        assert 1e6 * abs(mesh["dte_mean"].mean()) == pytest.approx(mean, abs=0.06)
