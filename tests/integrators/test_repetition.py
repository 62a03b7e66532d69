"""Steady running that is not computed again is the steady running that would be computed."""

import math

import numpy as np
import pytest
from planetary_twin_benchmark.samples import samples_until
from stability.sound import PAPER

import planetary_twin_py as pt
from planetary_twin_py._core import (
    BEARING,
    CHURNING,
    DAMPING,
    DTE,
    FRICTION,
    MESH_FORCE,
    STIFFNESS_WORK,
    WORK,
)
from planetary_twin_py.model.clock import TICKS
from planetary_twin_py.model.cycle import common_cycles
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.run.engine import Engine

TOLERANCE = 1e-3
RUNOUT = {"mesh.runout": {"sun": 2e-6}, "mesh.sun_planet_error": {"amplitudes": [1e-6]}}
RUNNING = {
    "paper": PAPER,
    "backwards": PAPER.replace(input_speed=-pt.rpm(1000)),
    "carrier turns": pt.load_scene("wind_turbine_stage"),
    "cracked tooth": pt.load_scene("cracked_tooth"),
    "runout": PAPER.replace(**RUNOUT),
    "fluctuating torque": PAPER.replace(torque_ripple=5.0),
    "lightly loaded, flanks part": pt.load_scene("lightly_loaded"),
    "without friction": PAPER.replace(**{"lubrication.friction": False}),
}
SLOW = ("carrier turns", "backwards")
PERIODS = 12.0  # of the speed loop, by which each of them has settled
EVERY_SCENE = pytest.mark.parametrize(
    "scene",
    [
        pytest.param(scene, id=name, marks=pytest.mark.exhaustive if name in SLOW else ())
        for name, scene in RUNNING.items()
    ],
)


class Settled:
    """A run of a scene until it has settled, and what is seen just before."""

    def __init__(self, scene, method):
        end = PERIODS / Gearbox(scene).bandwidth
        first = math.floor(end * 20_000) - 19
        self.engine = Engine(scene, TOLERANCE, method)
        begin, end = (self.engine._core.WindowEnd() for _ in range(2))
        self.engine.exact_end(0, begin)
        samples = samples_until(self.engine, (first + 19) / 20_000, first, 20_000.0, 20)
        self.dte, self.force = samples.mesh[:, DTE], samples.mesh[:, MESH_FORCE]
        ratio = self.engine.train.body.ratio[: self.engine.train.bodies]
        self.angle = math.tau * samples.turns @ ratio.T + samples.angle
        self.engine.exact_end(round((first + 19) / 20_000 * TICKS), end)
        self.ledger = end.ledger
        self.gain = end.kinetic + end.elastic - begin.kinetic - begin.elastic


@pytest.mark.slow
@EVERY_SCENE
def test_repeated_cycles_equal_computed_ones(scene):
    repeated, computed = Settled(scene, "auto"), Settled(scene, "march")
    assert repeated.engine.control.repeated > 0.2 * computed.engine.control.steps
    assert computed.engine.control.repeated == 0
    for name in ("dte", "force"):
        found, exact = getattr(repeated, name), getattr(computed, name)
        assert np.abs(found - exact).max() < TOLERANCE * np.abs(exact).max()
    cycles = abs(repeated.angle - computed.angle).max() * scene.gearset.teeth.sun / math.tau
    assert cycles < 0.1 * TOLERANCE
    assert repeated.ledger[[WORK, FRICTION]] == pytest.approx(
        computed.ledger[[WORK, FRICTION]], rel=0.1 * TOLERANCE
    )


@EVERY_SCENE
def test_energy_closes_over_repeated_cycles(scene):
    run = Settled(scene, "auto")
    lost = run.ledger[[FRICTION, DAMPING, BEARING, CHURNING]].sum() - run.ledger[STIFFNESS_WORK]
    machines = run.ledger[WORK : WORK + 2]
    assert abs(machines.sum() - lost - run.gain) < 1e-5 * np.abs(machines).sum()


def test_ten_minutes_later_gears_are_where_the_set_point_says():
    twin = pt.Twin(PAPER, 1.0)
    twin.advance(10.0)
    begin = twin.advance(1.0)
    assert begin.repeated
    for _ in range(10):
        end = twin.advance(60.0)
    turned = PAPER.operating_point.input_speed * 600.0
    sun = end.bodies.index("sun")
    drift = (end.angle[sun] - begin.angle[sun] - turned + math.pi) % math.tau - math.pi
    assert abs(drift) < 1e-9
    assert end.power_loss == pytest.approx(begin.power_loss, rel=1e-9)


@pytest.mark.parametrize("change", [{"lambda_ratio": 2.0}, {"input_torque": 20.0}])
def test_a_change_acts_at_its_instant_on_repeated_cycles(change):
    """Its path is that of a run in which nothing ever repeats."""
    seen, end = [], PERIODS / Gearbox(PAPER).bandwidth
    for method in ("auto", "march"):
        engine = Engine(PAPER, TOLERANCE, method)
        engine.sample(end)
        assert engine.repeats == (method == "auto")
        engine.change(PAPER.replace(**change).operating_point, TOLERANCE, end)
        assert not engine.repeats
        first = round(end * 20_000) + 1
        seen.append(samples_until(engine, end + 0.02, first, 20_000.0, 400).mesh)
    dte = [samples[:, 0] for samples in seen]
    assert np.abs(dte[0] - dte[1]).max() < TOLERANCE * np.abs(dte[1]).max()


def test_repetition_does_not_depend_on_the_windows():
    def path(window):
        twin, parts = pt.Twin(PAPER, 2e3), []
        for _ in range(round(2.5 / window)):
            end = twin.advance(window)
            parts.append(np.hstack([end.waveform.dte, end.waveform.mesh_force]))
        assert twin.advance(1e-3).repeated
        return np.vstack(parts), end.angle

    samples, angle = path(2.5)
    for window in (0.1, 2.5e-3):
        others, other_angle = path(window)
        assert np.array_equal(others, samples)
        assert np.array_equal(other_angle, angle)


CHAOTIC_RATTLE = {
    "input_speed": 1100.0,
    "input_torque": 5.0,
    "backlash": 1e-6,
    "mesh.damping.law": "viscous",
    "mesh.damping.damping_ratio": 0.01,
}


@pytest.mark.parametrize(
    "changes",
    [
        pytest.param(CHAOTIC_RATTLE, marks=pytest.mark.exhaustive, id="chaotic rattle"),
        pytest.param({"input_speed": 0.0}, id="standstill"),
    ],
)
def test_what_does_not_come_round_is_computed(changes):
    run = pt.simulate(PAPER.replace(**changes), 3.0, 1000.0, tolerance=TOLERANCE)
    assert run.stats.repeated_steps == 0


@pytest.mark.parametrize(
    ("changes", "cycles"),
    [
        ({}, 1),
        (RUNOUT, PAPER.gearset.teeth.sun),
        ({"mesh.runout": {"planet": 1e-6}}, PAPER.gearset.teeth.planet),
        ({"faults": [{"kind": "crack", "gear": "ring", "stiffness_loss": 0.1}]}, 70),
        ({"torque_ripple": 1.0, "drive.speed_control.ripple_order": 4}, 15),
        ({"torque_ripple": 1.0, "drive.speed_control.ripple_order": 30}, 1),
    ],
)
def test_all_is_as_before_when_teeth_and_waves_come_round(changes, cycles):
    scene = PAPER.replace(**changes)
    gearbox = Gearbox(scene)
    assert common_cycles(gearbox.train, gearbox.operation(scene.operating_point)) == cycles


def test_with_two_motors_the_motion_does_not_repeat():
    scene = pt.load_scene("differential")
    gearbox = Gearbox(scene)
    assert common_cycles(gearbox.train, gearbox.operation(scene.operating_point)) == 0


RESONANT = PAPER.replace(
    **{
        "backlash": 20e-6,
        "mesh.damping.law": "viscous",
        "mesh.damping.damping_ratio": 0.03,
        "drive.speed_control.slew_rate": 5.0,
        "drive.speed_limit": 1200.0,
    }
)


class Followed:
    """A run at a sequence of speeds [rpm], and its DTE once in each of the last mesh cycles."""

    def __init__(self, scene, method, *holds):
        first, _ = holds[0]
        self.engine = Engine(scene.replace(input_speed=pt.rpm(first)), TOLERANCE, method)
        end = 0.0
        for speed, duration in holds:
            point = scene.replace(input_speed=pt.rpm(speed)).operating_point
            self.engine.change(point, TOLERANCE, end)
            end += duration
            self.engine.sample(end)
        rate = speed / 60.0 * scene.gearset.teeth.sun
        start = math.ceil(end * rate) + 1
        samples = samples_until(self.engine, (start + 59) / rate, start, rate, 60)
        self.dte = samples.mesh[:, DTE]
        self.difference = np.ptp(self.dte, axis=0).max() / abs(self.dte).max()


@pytest.mark.slow
def test_a_motion_that_slowly_loses_stability_is_not_repeated():
    """Where the period doubles, 0.4 rpm past the bifurcation, the motion stays near the unstable
    cycle for a second before it leaves it by several tolerances."""
    scene = RESONANT.replace(input_torque=10.0)
    holds = (11000.0, 1.0), (10959.2, 3.0), (10958.8, 5.0)
    found, computed = (Followed(scene, method, *holds) for method in ("auto", "march"))
    assert computed.difference > 3.0 * TOLERANCE
    assert not found.engine.repeats
    assert found.difference == pytest.approx(computed.difference, rel=0.1)


def test_periodic_motion_before_its_period_doubles_is_repeated():
    found = Followed(RESONANT.replace(input_torque=10.0), "auto", (11000.0, 1.0), (10980.0, 3.0))
    assert found.engine.repeats


@pytest.mark.slow
@pytest.mark.parametrize(("speed", "leaves"), [(10335.0, False), (10336.0, True)])
def test_near_a_fold_the_run_stays_on_its_branch(speed, leaves):
    """Without separation, at 3 N m, the cycle ends in a fold at 10335.4 rpm."""
    holds = (10150.0, 1.0), (10334.8, 5.0), (speed, 3.0)
    found, computed = (
        Followed(RESONANT.replace(input_torque=3.0), method, *holds) for method in ("auto", "march")
    )
    assert (computed.difference > 0.01) == leaves
    assert (found.difference > 0.01) == leaves
    assert found.engine.repeats != leaves
