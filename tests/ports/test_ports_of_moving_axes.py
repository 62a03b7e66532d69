"""Ports of a gearbox whose axes move: energy, torsion as the limit, and repeated courses."""

import numpy as np
import pytest
from planar.moving_scenes import planar
from ports.ports_of_paper import course, driven

import planetary_twin_py as pt

MOVING = {
    "planar": planar(),
    "floating": pt.load_scene("floating_sun").replace(dynamics="planar"),
    "spatial": pt.load_scene("helical_stage"),
}
PORTS = [("torque", "torque"), ("torque", "motion"), ("motion", "torque")]


@pytest.mark.parametrize("ports", PORTS, ids="-".join)
def test_very_stiff_bearings_leave_the_ports_of_torsion(ports):
    stiff = driven(*ports, planar(bearings={"bearing": 1e11}))
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
    scene = driven("torque", "motion", MOVING[name])
    twin = pt.Twin(scene, tolerance=1e-3, keep_commands=True)
    for _, command in course(MOVING[name], ("torque", "motion"), "hold", 8):
        twin.step(1e-3, **command.values)
    window = twin.advance(2e-3)
    run = pt.simulate(scene, window.end, tolerance=1e-3, commands=twin.commands)
    last = run.time > window.start + 1e-12
    assert np.array_equal(run.dte[last], window.waveform.dte)
