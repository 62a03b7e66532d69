"""A twin that has run for a thousand hours is as exact as a new one.

It is not waited for: clock and whole turns of a new twin are set to what the hours leave in them.
"""

import math
from fractions import Fraction

import numpy as np
import pytest
from stability.sound import PAPER

import planetary_twin_py as pt
from planetary_twin_py.model.clock import TICKS

HOURS = 1000
MILLIONTH = Fraction(1, 10**6)  # of a sample period, within which a sample counts as reached
RUNNING = {
    "paper": PAPER,
    "cracked tooth": pt.load_scene("cracked_tooth"),
    "ring held": pt.load_scene("wind_turbine_stage"),
    "differential": pt.load_scene("differential"),
    "rattle": PAPER.replace(input_torque=0.3, torque_ripple=3.0),
}
EVERY_SCENE = pytest.mark.parametrize("scene", RUNNING.values(), ids=RUNNING)


def turned(scene, inputs):
    """Turns of all members and of a planet by those of the inputs (Willis 1841)."""
    zs, zp, zr = scene.gearset.tooth_numbers
    members = [machine.member for machine in scene.drive.inputs]
    turns = dict(zip(members, map(Fraction, inputs), strict=True)) | {scene.gearset.held: 0}
    weight = {"sun": zs, "ring": zr, "carrier": -(zs + zr)}
    (free,) = weight.keys() - turns.keys()
    turns[free] = -sum(weight[m] * turns[m] for m in weight if m != free) / Fraction(weight[free])
    carrier = turns["carrier"]
    return turns | {"planet": carrier - (turns["sun"] - carrier) * Fraction(zs, zp)}


def turns_after(scene, hours):
    """Turns of the inputs in so many hours, to the nearest at which teeth are where teeth were.

    Where one is faulty, it is to be back itself.
    """
    speeds = [scene.operating_point.input_speed, scene.operating_point.second_input_speed]
    common = math.lcm(*scene.gearset.tooth_numbers) if scene.faults else 1
    result = []
    for axis in range(len(scene.drive.inputs)):
        one = turned(scene, [int(axis == a) for a in range(len(scene.drive.inputs))])
        cycles = scene.gearset.teeth.sun * Fraction(one["sun"] - one["carrier"])
        period = cycles.denominator * common // math.gcd(cycles.numerator, common)
        result.append(round(speeds[axis] * 3600.0 * hours / math.tau / period) * period)
    return result


def aged(scene, hours=HOURS, sample_rate=50_000.0):
    """A twin of the scene after so many hours, and the turns that its inputs have made."""
    twin, turns = pt.Twin(scene, sample_rate), turns_after(scene, hours)
    integrator = twin._engine.integrator
    for state in (integrator.begin, integrator.end):
        state.seconds += 3600 * hours
        state.turns[: len(turns)] += turns
    twin._windows.ticks += 3600 * hours * TICKS
    twin._windows.begin()
    return twin, turns


def columns(window):
    """Every sample of a window."""
    wave = window.waveform
    return np.hstack([wave.dte, wave.mesh_force, wave.friction])


@EVERY_SCENE
def test_angles_after_1000_hours_are_those_of_exact_fractions(scene):
    (old, turns), young = aged(scene), pt.Twin(scene)
    kinds = turned(scene, turns)
    for _ in range(5):
        now, then = old.advance(0.01), young.advance(0.01)
        for name, late, early in zip(now.bodies, now.angle, then.angle, strict=True):
            added = float(kinds[name.split("_")[0]] % 1) * math.tau
            assert abs(math.remainder(late - early - added, math.tau)) < 1e-9


@pytest.mark.parametrize("hours", [HOURS, 200_000])
@EVERY_SCENE
def test_every_sample_is_that_of_the_first_hour(scene, hours):
    old, young = aged(scene, hours)[0], pt.Twin(scene)
    for _ in range(3):
        now, then = old.advance(0.01), young.advance(0.01)
        assert np.array_equal(columns(now), columns(then))


@EVERY_SCENE
def test_powers_and_speeds_of_window_are_those_of_the_first_hour(scene):
    old, young = aged(scene)[0], pt.Twin(scene)
    for length in (0.01, 1e-3, 1e-4):
        now, then = old.advance(length), young.advance(length)
        assert np.array_equal(now.machine_power, then.machine_power)
        assert now.power_loss == then.power_loss and now.efficiency == then.efficiency
        assert now.stored_power == then.stored_power
        assert now.mean_speed == pytest.approx(then.mean_speed, rel=1e-12, abs=1e-9)


@pytest.mark.parametrize("rate", [50_000.0, 44_100.0, 3000.0, 1000.0 / 3.0, 12_345.678])
def test_samples_lie_on_one_clock_and_none_is_lost(rate):
    twin = aged(PAPER, sample_rate=rate)[0]
    begin, step = Fraction(3600 * HOURS), Fraction(1, 100)
    number = math.floor(begin * Fraction(rate) + MILLIONTH)
    for n in range(1, 21):
        window = twin.advance(0.01)
        last = math.floor((begin + n * step) * Fraction(rate) + MILLIONTH)
        exact = [float(k / Fraction(rate)) for k in range(number + 1, last + 1)]
        assert np.array_equal(window.waveform.time, exact)
        assert (window.start, window.end) == (
            float(begin + (n - 1) * step),
            float(begin + n * step),
        )
        number = last


@pytest.mark.parametrize("change", [{"backlash": 4e-7}, {"input_speed": 90.0}], ids=str)
def test_a_change_acts_at_its_instant_as_in_the_first_hour(change):
    old, young = aged(PAPER)[0], pt.Twin(PAPER)
    for twin in (old, young):
        twin.advance(0.01234567)
        twin.set(**change)
    assert old.log[-1].time == 3600_000.01234567
    now, then = old.advance(0.01), young.advance(0.01)
    assert np.array_equal(columns(now), columns(then))


def test_the_ledger_keeps_less_than_a_step_between_windows():
    """Else 1e-3 J of a step would be added to the 2e10 J of a thousand hours."""
    twin = pt.Twin(PAPER)
    added = [twin.advance(0.01) for _ in range(10)]
    step = twin._engine.control.step
    strongest = max(abs(window.machine_power).max() for window in added)
    assert np.abs(twin._engine.integrator.end.energy[:2]).max() < 1.1 * strongest * step
    whole = pt.Twin(PAPER).advance(0.1)
    parts = np.mean([window.machine_power for window in added], axis=0)
    assert parts == pytest.approx(whole.machine_power, rel=1e-12)
