"""Directions up and down: one motion if only one is possible, two where flanks may separate."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.studies.bifurcation import DOWN, UP, Dwell, bifurcation

PAPER = pt.load_scene("paper")
# Lightly loaded and damped, with backlash: near the first natural frequency flanks may separate.
LOOSE = PAPER.replace(
    **{
        "input_torque": 10.0,
        "backlash": 2e-5,
        "mesh.damping.loss_factor": 0.006,
        "drive.speed_limit": pt.rpm(13_000),
    }
)
TWICE = pt.rpm(10_280)  # at which two motions are possible
DTE = "sun_planet_1_dte"


def seen(table, direction, speed):
    """DTE of the first mesh at one speed in one direction [m]."""
    rows = zip(table["direction"], table["input_speed"], table[DTE], strict=True)
    found = [
        dte.as_py()
        for way, at, dte in rows
        if way.as_py() == direction and math.isclose(at.as_py(), speed)
    ]
    return np.array(found)


def test_both_directions_find_the_only_possible_motion():
    speeds = [pt.rpm(speed) for speed in (4000, 4050, 4100)]
    failures = []
    table = bifurcation(
        PAPER, speeds, Dwell(0.3, cycles=10), lambda done, failure: failures.append(failure)
    )
    assert failures == [None] * 6 and len(table) == 6 * 10
    swing = np.ptp(pt.simulate(PAPER.replace(input_speed=speeds[1]), 0.05).dte[:, 0])
    for speed in speeds:
        up, down = seen(table, UP, speed), seen(table, DOWN, speed)
        assert np.ptp(np.append(up, down)) < 5e-3 * swing


def independent(start_speed, settling):
    """Sections of a separate run at TWICE, started at another speed: by interpolation [m]."""
    scene = LOOSE.replace(input_speed=TWICE, **{"drive.speed_control.start_speed": start_speed})
    run = pt.simulate(scene, settling + 0.02, 200_000.0, tolerance=1e-4)
    late = run.time > settling
    cycles = scene.gearset.teeth.sun * run.angle[late, 0] / (2.0 * math.pi)
    whole = np.arange(math.ceil(cycles[0]), math.floor(cycles[-1]))
    return np.interp(whole, cycles, run.dte[late, 0])


@pytest.mark.exhaustive
def test_each_direction_keeps_its_motion_if_two_are_possible():
    """Both repeat with the meshing; their sections are 1.2 um apart."""
    speeds = [pt.rpm(speed) for speed in (10_000, 10_070, 10_140, 10_210, 10_280, 10_380, 10_480)]
    table = bifurcation(LOOSE, speeds, Dwell(0.2, cycles=60))
    together, parting = seen(table, UP, TWICE), seen(table, DOWN, TWICE)
    assert together.mean() - parting.mean() > 1e-6
    smeared = 5e-8  # by shafts that still ring
    assert max(np.ptp(together), np.ptp(parting)) < smeared
    assert independent(pt.rpm(10_100), 0.6) == pytest.approx(together.mean(), abs=smeared)
    # Started at the static deflection, the motion is chaotic for up to half a second.
    assert independent(None, 1.0) == pytest.approx(parting.mean(), abs=smeared)


@pytest.mark.parametrize(
    ("scene", "speeds", "dwell", "message"),
    [
        (PAPER, [100.0], Dwell(), "input_speed = 100 rad/s: must be at least two"),
        (PAPER, [-100.0, 100.0], Dwell(), "all above or all below 0"),
        (PAPER, [100.0, 200.0], Dwell(settling=0.0), "settling = 0.0 s"),
    ],
)
def test_invalid_input_is_refused_in_one_line(scene, speeds, dwell, message):
    with pytest.raises(ValueError, match=message) as refusal:
        bifurcation(scene, speeds, dwell)
    assert "\n" not in str(refusal.value)
