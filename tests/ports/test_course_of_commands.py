"""A run under commands is repeated bit for bit, whatever its windows."""

import warnings

import numpy as np
import pytest
from ports.ports_of_paper import PAPER, driven

import planetary_twin_py as pt

SPAN = 0.02  # [s]


def commanded(interpolation):
    """A scene and a course of commands at uneven times."""
    scene = driven("torque", "motion", **{"drive.interpolation": interpolation})
    time = np.array([0.0, 0.0013, 0.004, 0.0041, 0.009, 0.0123456789, 0.015])
    torque = np.array([63.0, 70.0, np.nan, 20.0, -30.0, 40.0, 63.0])
    speed = np.array([-44.88, -44.8, -44.9, np.nan, -45.0, -44.7, -44.88])
    return scene, pt.Commands(time, input_torque=torque, output_speed=speed)


def simulated(scene, commands):
    return pt.simulate(scene, SPAN, tolerance=1e-3, method="auto", commands=commands)


def by_windows(scene, commands, cuts):
    """All samples of a twin that is advanced from one cut or command to the next."""
    twin = pt.Twin(scene, tolerance=1e-3)
    linear = scene.drive.interpolation == "linear"
    parts, times = [], sorted({*commands.time, *cuts, SPAN} - {0.0})
    for end in times:
        if end - twin.time < 1e-12:
            continue  # a cut at a command
        when = end if linear else twin.time
        values = {
            name: float(getattr(commands, name)[n])
            for n in np.flatnonzero(np.abs(commands.time - when) < 1e-13)
            for name in ("input_torque", "output_speed")
            if not np.isnan(getattr(commands, name)[n])
        }
        window = twin.advance(end - twin.time, **values)
        parts.append(window.waveform)
    return np.vstack([np.hstack([part.dte, part.mesh_force]) for part in parts])


@pytest.mark.parametrize("cuts", [(), (0.0005, 0.0039, 0.0142), tuple(np.arange(1, 20) * 1e-3)])
def test_held_commands_have_the_same_samples_in_any_windows(cuts):
    scene, commands = commanded("hold")
    run = simulated(scene, commands)
    samples = by_windows(scene, commands, cuts)
    assert np.array_equal(samples, np.hstack([run.dte, run.mesh_force]))


def test_a_twin_keeps_commands_only_if_asked():
    with pytest.raises(ValueError, match="keep_commands"):
        _ = pt.Twin(PAPER).commands


@pytest.mark.parametrize(
    ("time", "torque", "message"),
    [
        ([0.0, 0.0], [1.0, 2.0], "increasing"),
        ([0.0, np.nan], [1.0, 2.0], "finite"),
        ([-1.0], [1.0], "at least 0"),
        ([0.0, 1.0], [1.0], "has shape"),
    ],
)
def test_a_course_that_makes_no_sense_is_refused(time, torque, message):
    with pytest.raises(ValueError, match=message):
        pt.Commands(np.array(time), input_torque=np.array(torque))


@pytest.mark.parametrize("interpolation", ["hold", "linear"])
def test_commands_that_do_not_act_before_the_end_are_named(interpolation):
    scene, commands = commanded(interpolation)
    with pytest.warns(UserWarning, match="at 0.009 s or later has no effect"):
        pt.simulate(scene, 0.005, tolerance=1e-3, commands=commands)
    with warnings.catch_warnings():
        warnings.filterwarnings("error", message="commands.time")
        pt.simulate(scene, 0.0151, tolerance=1e-3, commands=commands)
