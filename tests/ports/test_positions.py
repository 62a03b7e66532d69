"""Positions as commands: a shaft whose motion is given reaches them at the end of its step."""

import math

import numpy as np
import pytest
from ports.ports_of_paper import PAPER, RATIO, at_rest, driven
from stability.sound import turnover

import planetary_twin_py as pt

EXACT = 1e-12  # [rad] rounding of angles


def test_a_position_is_reached_at_the_end_of_the_step_and_held():
    twin = pt.Twin(at_rest("torque", "motion"))
    goal = twin.port_states.output_angle + 2e-3
    shown = twin.step(1e-3, output_position=goal)
    assert shown.output_angle == pytest.approx(goal, abs=EXACT)
    assert shown.output_speed == pytest.approx(2.0, rel=1e-9)  # constant: 2 mrad in 1 ms
    for _ in range(5):
        shown = twin.step(1e-3)
        assert shown.output_angle == pytest.approx(goal, abs=EXACT)
        assert shown.output_speed == pytest.approx(0.0, abs=1e-12)


def test_positions_have_no_drift():
    """Each step is computed from the present angle, so errors of rounding do not add up."""
    twin = pt.Twin(at_rest("torque", "motion"))
    begin = twin.port_states.output_angle
    for n in range(2000):
        goal = begin + 0.01 * math.sin(0.1 * n)
        shown = twin.step(1e-3, output_position=goal)
    assert shown.output_angle == pytest.approx(goal, abs=EXACT)


def test_held_and_turned_shafts_have_the_torque_of_springs():
    """Both shafts and, of each mesh, the transmission error, from the torque that comes out."""
    damped = {"drive.input.coupling_damping": 2.0, "drive.output.coupling_damping": 10.0}
    twin = pt.Twin(at_rest("motion", "motion", **damped), tolerance=1e-4)
    slack = twin.advance(2e-5).waveform.dte[-1]
    begin = twin.port_states.output_angle
    turned = 0.02
    for share in np.linspace(0.0, 1.0, 201)[1:]:
        twin.step(1e-3, output_position=begin + share * turned)
    for _ in range(300):
        shown = twin.step(1e-3)
    torque = shown.output_torque
    sun_mesh, ring_mesh = (twin.advance(1e-3).waveform.dte[-1] - slack)[[0, 3]]
    base_radius = 0.4e-3 * 30 * math.cos(PAPER.gearset.pressure_angle)
    yielded = (sun_mesh + ring_mesh) / base_radius * -RATIO  # as an angle of the output
    shafts = torque / 3000.0 + torque * RATIO**2 / 500.0
    assert shafts + yielded == pytest.approx(turned, rel=1e-6)
    assert shown.input_torque == pytest.approx(-torque * RATIO, rel=1e-6)


def mixed(twin, seed):
    """Torques, positions, positions with speeds, speeds and nothing, in steps of uneven length."""
    rng = np.random.default_rng(seed)
    for _ in range(40):
        dt = float(rng.choice([1e-3, 4e-4, 1.7e-3]))
        command = {}
        if rng.random() < 0.7:
            command["input_torque"] = 63.0 + 9.0 * rng.standard_normal()
        kind = rng.integers(4)
        angle, speed = twin.port_states.output_angle, -44.88 + 0.3 * rng.standard_normal()
        if kind < 2:
            command["output_position"] = angle + speed * dt
        if kind in (1, 2):
            command["output_speed"] = speed
        twin.step(dt, **command)


@pytest.mark.parametrize("interpolation", ["hold", "linear"])
@pytest.mark.parametrize("seed", [1, 2])
def test_steps_with_positions_are_repeated_bit_for_bit(interpolation, seed):
    scene = driven("torque", "motion", **{"drive.interpolation": interpolation})
    twin = pt.Twin(scene, tolerance=1e-3, keep_commands=True)
    mixed(twin, seed)
    window = twin.advance(2e-3)
    run = pt.simulate(scene, window.end, tolerance=1e-3, commands=twin.commands)
    last = run.time > window.start + 1e-12
    assert np.array_equal(run.dte[last], window.waveform.dte)
    assert np.array_equal(run.mesh_force[last], window.waveform.mesh_force)


@pytest.mark.parametrize("interpolation", ["hold", "linear"])
def test_the_ledger_closes_under_positions(interpolation):
    scene = driven("torque", "motion", **{"drive.interpolation": interpolation})
    twin = pt.Twin(scene, tolerance=1e-5, keep_commands=True)
    mixed(twin, 3)
    run = pt.simulate(scene, twin.time, tolerance=1e-5, commands=twin.commands).energy
    assert run.friction > 0.0
    assert abs(run.residual) < 1e-6 * turnover(run)


REFUSED = [
    ({"output_position": 1.0}, r"output_position = 1.0 rad: must be within .*drive.speed_limit"),
    ({"output_position": math.nan}, "output_position = nan rad: must be finite"),
    ({"output_position": math.inf}, "output_position = inf rad: must be finite"),
    ({"input_position": 0.0}, r"input_position = 0.0: requires drive.input.port = 'motion'"),
    ({"output_speed": 1e9, "output_position": 0.0}, "output_speed = 1000000000.0 rad/s: must be"),
]


@pytest.mark.parametrize(("command", "message"), REFUSED)
def test_unreachable_positions_are_refused_and_change_nothing(command, message):
    twin, untouched = (pt.Twin(driven("torque", "motion")) for _ in range(2))
    for call in (twin.step, twin.advance):
        with pytest.raises(ValueError, match=message) as refusal:
            call(1e-3, **command)
        assert "\n" not in str(refusal.value)
    assert twin.time == 0.0
    assert np.array_equal(twin.advance(1e-3).waveform.dte, untouched.advance(1e-3).waveform.dte)
