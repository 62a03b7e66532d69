"""Ports that change while a twin runs: nothing jumps, and energy is neither lost nor made."""

import itertools

import numpy as np
import pytest
from ports.ports_of_paper import CAUSALITIES, PAPER, exact_end

import planetary_twin_py as pt

PAIRS = list(itertools.product(CAUSALITIES, repeat=2))
LENGTH = 2e-3  # [s] of a window
UNDAMPED = {
    "mesh.double_pair_ratio": 1.0,
    "mesh.damping.loss_factor": 0.0,
    "drive.input.coupling_damping": 0.0,
    "drive.output.coupling_damping": 0.0,
}


def names(ports):
    return {"drive.input.port": ports[0], "drive.output.port": ports[1]}


def stored(twin):
    end = exact_end(twin)
    return end.kinetic + end.elastic


def of_shafts(twin, ports):
    """Kinetic energy of motor and load [J], as far as they are part of the train."""
    shown, drive = twin.port_states, twin.scene.drive
    sides = (drive.input.inertia, shown.input_speed), (drive.output.inertia, shown.output_speed)
    return sum(
        0.5 * inertia * speed**2
        for (inertia, speed), port in zip(sides, ports, strict=True)
        if port != "motion"
    )


def kinematics(twin):
    shown = twin.port_states
    return [shown.input_angle, shown.output_angle, shown.input_speed, shown.output_speed]


@pytest.mark.parametrize("before", PAIRS, ids="-".join)
def test_angles_and_speeds_of_the_shafts_are_continuous(before):
    """From each pair of ports to each other one, with the inertia of motor and load."""
    twin = pt.Twin(PAPER.replace(**names(before)), tolerance=1e-4)
    twin.advance(0.0123)
    for after in PAIRS:
        twin.set(**names(after))
        shown, energy = kinematics(twin), stored(twin) - of_shafts(twin, after)
        twin.set(**names(before))
        assert kinematics(twin) == pytest.approx(shown, rel=1e-12)
        assert stored(twin) - of_shafts(twin, before) == pytest.approx(energy, rel=1e-12)
        twin.set(**names(after))
        twin.step(1e-7)
        assert kinematics(twin) == pytest.approx(shown, rel=1e-4)
        twin.set(**names(before))


def test_energy_balances_across_changes_of_ports():
    """Work at the ports = losses + what the train stores, and the motors that join or leave it.

    The stored energy is that of the state at the begin and at the end, not of the windows. Nothing
    damps, which is not counted as a loss, and teeth have one stiffness, whose changes do no work.
    """
    twin = pt.Twin(PAPER.replace(**UNDAMPED), tolerance=1e-5)
    twin.advance(0.01)
    begin, came, work, lost = stored(twin), 0.0, 0.0, 0.0
    rng = np.random.default_rng(7)
    for after in PAIRS[1:] + PAIRS[:1]:
        before = twin.ports
        speed = twin.port_states.input_speed
        came -= of_shafts(twin, before)
        twin.set(**names(after), input_torque=63.0 + 5.0 * rng.standard_normal())
        came += of_shafts(twin, after)
        given = {}
        if after[0] == "motion":
            given["input_speed"] = speed * 1.001
        if after[1] == "torque":
            given["output_torque"] = 150.0
        for n in range(10):
            window = twin.advance(LENGTH, **(given if n == 0 else {}))
            work += LENGTH * (window.input_power - window.output_power - window.power_loss)
            lost += LENGTH * window.power_loss
    gained = stored(twin) - begin
    assert gained == pytest.approx(came + work, abs=2e-3 * lost)


def test_ports_and_operating_point_change_together_or_not_at_all():
    twin, untouched = pt.Twin(PAPER), pt.Twin(PAPER)
    for each in (twin, untouched):
        each.advance(0.01)
    for changes, message in (
        ({"drive.input.port": "torque", "input_speed": 1e6}, "input_speed = 1000000.0: must be"),
        ({"drive.input.port": "pedal", "input_speed": 90.0}, "drive.input.port = 'pedal': must be"),
        ({"drive.input.part": "torque"}, "drive.input.part: no such field"),
    ):
        with pytest.raises(ValueError) as refusal:
            twin.set(**changes)
        assert str(refusal.value).startswith(message) and "\n" not in str(refusal.value)
    assert len(twin.log) == 1
    assert np.array_equal(twin.advance(0.01).waveform.dte, untouched.advance(0.01).waveform.dte)
    twin.set(**{"drive.input.port": "torque", "backlash": 3e-7})
    assert twin.log[-1].time == twin.time == 0.02
    assert (twin.ports.input, twin.operating_point.backlash) == ("torque", 3e-7)
    assert len(twin.log) == 2
