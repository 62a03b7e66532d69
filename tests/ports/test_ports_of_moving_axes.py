"""Ports of a gearbox whose axes move: energy, torsion as the limit, and repeated courses."""

import numpy as np
import pytest
from planar.moving_scenes import planar
from stability.sound import turnover
from tiers import first

import planetary_twin_py as pt

MOVING = {
    "planar": planar(),
    "floating": pt.load_scene("floating_sun").replace(dynamics="planar"),
    "spatial": pt.load_scene("helical_stage"),
}
PORTS = [("torque", "torque"), ("torque", "motion"), ("motion", "torque"), ("machine", "torque")]


def driven(scene, input, output, **changes):
    return scene.replace(**{"drive.input.port": input, "drive.output.port": output, **changes})


def course(scene, ports, interpolation, count=20):
    """Commands around steady running, each millisecond, as the ports take them."""
    twin = pt.Twin(driven(scene, "motion", "motion"))
    shown = twin.port_states
    time = np.arange(count) * 1e-3
    wave = np.sin(2.0 * np.pi * 80.0 * time)
    swing = {"torque": 0.2 * wave, "speed": 1e-3 * wave * (interpolation == "linear")}
    names = {"torque": "torque", "motion": "speed"}
    used = [
        (f"{side}_{names[port]}", names[port])
        for side, port in zip(("input", "output"), ports, strict=True)
        if port != "machine"
    ]
    return pt.Commands(
        time, **{name: getattr(shown, name) * (1.0 + swing[kind]) for name, kind in used}
    )


@pytest.mark.parametrize("interpolation", first(1, ["linear", "hold"]))
@pytest.mark.parametrize("ports", PORTS, ids="-".join)
@pytest.mark.parametrize("name", MOVING)
def test_the_ledger_closes_under_commands(name, ports, interpolation):
    scene = driven(MOVING[name], *ports, **{"drive.interpolation": interpolation})
    commands = course(MOVING[name], ports, interpolation)
    energy = pt.simulate(scene, 0.025, tolerance=1e-5, commands=commands).energy
    assert energy.friction > 0.0
    assert abs(energy.residual) < 1e-6 * turnover(energy)


@pytest.mark.parametrize("ports", PORTS[:3], ids="-".join)
def test_very_stiff_bearings_leave_the_ports_of_torsion(ports):
    stiff = driven(planar(bearings={"bearing": 1e11}), *ports)
    held = stiff.replace(dynamics="torsional", supports=None)
    commands = course(planar(), ports, "hold")
    shown = []
    for scene in (stiff, held):
        twin = pt.Twin(scene, tolerance=1e-5)
        for _, command in commands:
            states = twin.step(1e-3, **command.values)
        shown.append(states.copy())
    found, expected = shown
    for name in ("input_speed", "output_speed", "input_torque", "output_torque"):
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=2e-4)


@pytest.mark.parametrize("name", MOVING)
def test_steps_are_repeated_by_simulate(name):
    scene = driven(MOVING[name], "torque", "motion")
    twin = pt.Twin(scene, tolerance=1e-3, keep_commands=True)
    for _, command in course(MOVING[name], ("torque", "motion"), "hold", 8):
        twin.step(1e-3, **command.values)
    window = twin.advance(2e-3)
    run = pt.simulate(scene, window.end, tolerance=1e-3, commands=twin.commands)
    last = run.time > window.start + 1e-12
    assert np.array_equal(run.dte[last], window.waveform.dte)


@pytest.mark.parametrize("name", MOVING)
def test_a_new_backlash_keeps_the_torque_at_a_port(name):
    twin = pt.Twin(driven(MOVING[name], "torque", "motion"))
    twin.advance(0.002)
    given = 1.1 * twin.port_states.input_torque
    twin.step(1e-4, input_torque=given)
    twin.set(backlash=1.1 * MOVING[name].operating_point.backlash)
    twin.advance(0.002)
    assert twin.port_states.input_torque == given
