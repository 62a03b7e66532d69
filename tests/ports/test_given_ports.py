"""Ports at which torque or motion is given, against closed forms of the rigid and elastic train."""

import math

import numpy as np
import pytest
from ports.ports_of_paper import (
    NO_FRICTION,
    PAPER,
    RATIO,
    at_rest,
    driven,
    inertia_at_input,
    momentum,
)

import planetary_twin_py as pt

DAMPED = {"drive.input.coupling_damping": 2.0, "drive.output.coupling_damping": 10.0}


def test_a_torque_on_a_free_train_speeds_it_up_as_a_rigid_one():
    scene = at_rest("torque", "torque")
    twin = pt.Twin(scene, tolerance=1e-4)
    for _ in range(200):
        shown = twin.step(1e-3, input_torque=2.0, output_torque=0.0)
    inertia = inertia_at_input(scene)
    swing = 2.0 / inertia / math.sqrt(500.0 / 5e-3)  # acceleration over the slowest shaft mode
    assert shown.input_speed == pytest.approx(0.2 * 2.0 / inertia, abs=swing)
    assert shown.output_speed == pytest.approx(RATIO * 0.2 * 2.0 / inertia, abs=swing)
    assert shown.time == pytest.approx(0.2, abs=1e-12)


def test_a_locked_output_holds_the_torque_and_the_shafts_twist():
    twin = pt.Twin(at_rest("torque", "motion", **DAMPED), tolerance=1e-4)
    slack = twin.advance(2e-5).waveform.dte[-1]  # flanks just touch
    for torque in np.linspace(0.0, 63.0, 201)[1:]:
        twin.step(1e-3, input_torque=float(torque), output_speed=0.0)
    for _ in range(300):
        shown = twin.step(1e-3)
    window = twin.advance(1e-3)
    assert shown.output_torque == pytest.approx(63.0 / -RATIO, rel=1e-6)
    assert shown.input_speed == pytest.approx(0.0, abs=1e-6)
    assert shown.output_speed == pytest.approx(0.0, abs=1e-12)
    # Both shafts, and d of both meshes: x_sun = d_sun + d_ring where carrier and ring stand still.
    sun_mesh, ring_mesh = (window.waveform.dte[-1] - slack)[[0, 3]]
    yielded = (sun_mesh + ring_mesh) / _base_radius(30)
    twist = 63.0 / 500.0 + 63.0 / RATIO**2 / 3000.0
    assert shown.input_angle == pytest.approx(twist + yielded, rel=1e-6)


def _base_radius(teeth):
    return 0.4e-3 * teeth * math.cos(PAPER.gearset.pressure_angle)


def test_friction_takes_from_a_train_that_is_driven_backwards():
    """At steady speed, the torque that comes out at the input is less than the lossless one."""
    scene = driven("motion", "torque", input_speed=-pt.rpm(1000), input_torque=63.0)
    twin = pt.Twin(scene)
    for _ in range(100):
        twin.advance(1e-3, output_torque=147.0)
    window = twin.advance(0.1)
    assert window.input_speed == pytest.approx(-pt.rpm(1000), rel=1e-9)
    assert window.power_loss > 0.0
    assert window.output_torque == pytest.approx(147.0, rel=1e-12)
    assert 0.0 < window.input_torque < 63.0
    balance = window.input_power - window.output_power - window.power_loss - window.stored_power
    assert abs(balance) < 1e-3 * abs(window.input_power)


def test_a_reversed_torque_crosses_the_backlash():
    """Both meshes change their flanks, so the sun turns by 2 b/r more than its springs yield."""
    backlash, torque = 2e-5, 20.0
    scene = at_rest("torque", "motion", backlash=backlash, **DAMPED)
    twin = pt.Twin(scene, tolerance=1e-4)

    def settle(value):
        for share in np.linspace(0.0, 1.0, 101)[1:]:
            twin.step(1e-3, input_torque=float(value * share))
        for _ in range(500):
            shown = twin.step(1e-3)
        return shown.copy(), twin.advance(1e-3).waveform

    up, dte_up = settle(torque)
    down, dte_down = settle(-torque)
    assert (dte_up.mesh_force[-1] > 0.0).all()
    assert (dte_down.mesh_force[-1] < 0.0).all()
    shafts = 2.0 * torque * (1.0 / 500.0 + 1.0 / RATIO**2 / 3000.0)
    play = 2.0 * backlash / _base_radius(30)
    # Meshes yield by F/k, where k is that of one to two pairs of teeth.
    force = torque / (3 * _base_radius(30))
    least, most = (4.0 * force / (2e8 * pairs) / _base_radius(30) for pairs in (1.75, 1.0))
    lost = up.input_angle - down.input_angle
    assert shafts + play + 0.99 * least < lost < shafts + play + 1.01 * most
    assert play > 5.0 * (most - least)  # the play is what is measured


def test_a_given_motion_is_kept_exactly():
    twin = pt.Twin(driven("motion", "torque"))
    shown = twin.step(1e-3)
    begin = shown.input_angle
    for n in range(100):
        shown = twin.step(1e-3, input_speed=100.0 + n)
        assert shown.input_speed == pytest.approx(100.0 + n, rel=1e-14)
    turned = 1e-3 * sum(100.0 + n for n in range(100))
    assert shown.input_angle - begin == pytest.approx(turned, rel=1e-12)


def test_straight_lines_between_commands():
    twin = pt.Twin(driven("motion", "torque", **{"drive.interpolation": "linear"}))
    begin = twin.step(1e-3).input_angle
    first = twin.step(0.01).input_speed
    assert first == pytest.approx(pt.rpm(1000), rel=1e-14)
    half = twin.step(0.02, input_speed=200.0, output_torque=100.0)
    assert half.input_speed == pytest.approx(200.0, rel=1e-13)
    assert half.output_torque == pytest.approx(100.0, rel=1e-12)
    turned = 0.01 * first + 0.02 * 0.5 * (first + 200.0)
    assert half.input_angle - begin == pytest.approx(turned, rel=1e-12)
    after = twin.step(0.01)  # stays where it is
    assert after.input_speed == pytest.approx(200.0, rel=1e-13)
    assert after.output_torque == pytest.approx(100.0, rel=1e-12)


@pytest.mark.parametrize("method", ["collocation", "rosenbrock"])
@pytest.mark.parametrize(("input", "output"), [("torque", "motion"), ("motion", "torque")])
def test_both_methods_agree_with_a_tight_run(input, output, method):
    scene = driven(input, output, **{"drive.interpolation": "linear"})
    time = np.arange(1, 11) * 1e-3
    every = {
        "input_torque": 60.0 + 10.0 * np.sin(300.0 * time),
        "input_speed": 104.0 + 0.5 * np.sin(300.0 * time),
        "output_torque": 140.0 + 3.0 * np.cos(500.0 * time),
        "output_speed": -44.8 - 0.2 * np.sin(500.0 * time),
    }
    quantity = {"torque": "torque", "motion": "speed"}
    names = f"input_{quantity[input]}", f"output_{quantity[output]}"
    course = {name: every[name] for name in names}
    commands = pt.Commands(time, **course)
    runs = [
        pt.simulate(scene, 0.012, 20_000.0, how, tolerance, commands=commands)
        for how, tolerance in ((method, 1e-5), ("collocation", 1e-7))
    ]
    error = np.abs(runs[0].dte - runs[1].dte).max() / np.abs(runs[1].dte).max()
    assert error < 2e-4


def test_what_moves_a_shaft_is_not_part_of_the_train():
    """The inertia at a port whose motion is given has no effect."""
    light, heavy = (
        pt.Twin(driven("motion", "torque", **{"drive.input.inertia": inertia}))
        for inertia in (5e-3, 5.0)
    )
    for n in range(20):
        a, b = (
            twin.step(1e-3, input_speed=104.0 + 0.1 * n, output_torque=140.0).copy()
            for twin in (light, heavy)
        )
    assert a.input_torque == pytest.approx(b.input_torque, rel=1e-6)
    assert a.output_speed == pytest.approx(b.output_speed, rel=1e-9)


REFUSED = [
    ("machine", "torque", {"input_torque": 1.0}, "input_torque = 1.0: requires drive.input.port"),
    ("torque", "torque", {"input_speed": 1.0}, "input_speed = 1.0: requires drive.input.port"),
    (
        "torque",
        "torque",
        {"output_torque": 1e9},
        "output_torque = 1000000000.0 N m: must be within",
    ),
    ("torque", "torque", {"input_torque": math.nan}, "input_torque = nan N m: must be within"),
    ("motion", "torque", {"input_speed": -1e4}, "input_speed = -10000.0 rad/s: must be within"),
]


NO_NUMBERS = [np.array([0.1]), np.array([0.1, 0.2]), [0.1], "0.1", 1j]


@pytest.mark.parametrize("value", NO_NUMBERS, ids=repr)
@pytest.mark.parametrize("port", ["machine", "torque"])
def test_a_torque_that_is_no_number_is_refused(port, value):
    twin, untouched = (pt.Twin(driven(port, "torque")) for _ in range(2))
    for call in (twin.step, twin.advance):
        with pytest.raises(ValueError) as refusal:
            call(1e-3, input_torque=value)
        assert str(refusal.value) == f"input_torque = {value!r}: must be a number [N m]"
    assert twin.time == 0.0
    assert np.array_equal(twin.advance(1e-3).waveform.dte, untouched.advance(1e-3).waveform.dte)


@pytest.mark.parametrize("value", [*NO_NUMBERS, None], ids=repr)
def test_a_duration_that_is_no_number_is_refused_with_its_name(value):
    twin = pt.Twin(driven("torque", "torque"))
    for call, name in ((twin.step, "dt"), (twin.advance, "duration")):
        with pytest.raises(ValueError) as refusal:
            call(value)
        assert str(refusal.value) == f"{name} = {value!r}: must be a number [s]"
    with pytest.raises(ValueError, match=r"sample_rate = .*: must be a number \[Hz\]"):
        twin.set_sample_rate(value)
    with pytest.raises(ValueError, match=r"tolerance = .*: must be a number$"):
        twin.set_tolerance(value)
    assert twin.time == 0.0


@pytest.mark.parametrize(("input", "output", "command", "message"), REFUSED)
def test_commands_that_a_port_does_not_take_are_refused(input, output, command, message):
    twin, untouched = pt.Twin(driven(input, output)), pt.Twin(driven(input, output))
    for call in (twin.step, twin.advance):
        with pytest.raises(ValueError) as refusal:
            call(1e-3, **command)
        assert str(refusal.value).startswith(message)
        assert "\n" not in str(refusal.value)
    assert twin.time == 0.0
    assert np.array_equal(twin.advance(1e-3).waveform.dte, untouched.advance(1e-3).waveform.dte)


def test_ports_that_a_scene_cannot_give_are_refused():
    with pytest.raises(ValueError, match=r"drive\.input\.port = 'torque': requires dynamics"):
        PAPER.replace(dynamics="quasi_static", **{"drive.input.port": "torque"})
    with pytest.raises(ValueError, match=r"dt = 2\.0 s: must be above 0 and at most 1"):
        pt.Twin(PAPER).step(2.0)


def test_constant_torque_on_free_train_stops_run_with_a_reason():
    twin = pt.Twin(at_rest("torque", "torque"))
    with pytest.raises(pt.RunawayError, match=r"speed of .* must be at most .* drive.speed_limit"):
        for _ in range(1000):
            twin.step(0.01, input_torque=1000.0, output_torque=0.0)
    reached = twin.time
    with pytest.raises(pt.RunawayError):
        twin.step(0.01)
    assert twin.time == reached


def test_only_torques_at_ports_change_the_momentum_of_the_train():
    """Springs, dampers and backlash between the bodies do no work in its rigid motion."""
    scene = driven("torque", "torque", **NO_FRICTION)
    time = np.arange(20) * 1e-3
    torque, load = 63.0 + 30.0 * np.sin(400.0 * time), 147.0 + 40.0 * np.cos(300.0 * time)
    commands = pt.Commands(time, input_torque=torque, output_torque=load)

    def momentum_at(end):
        run = pt.simulate(scene, end, 1e4, tolerance=1e-4, commands=commands)
        twin = pt.Twin(scene, tolerance=1e-4)
        for n in range(round(end / 1e-3)):
            shown = twin.step(1e-3, input_torque=torque[n], output_torque=load[n])
        return momentum(scene, run, shown)

    impulse = 1e-3 * (torque[5:20] + RATIO * load[5:20]).sum()
    gained = momentum_at(0.02) - momentum_at(0.005)
    assert gained == pytest.approx(impulse, abs=1e-8 * momentum_at(0.02))
    assert abs(impulse) > 1e-3 * momentum_at(0.02)
