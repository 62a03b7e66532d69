"""Directions up and down: one motion if only one is possible, two where flanks may separate."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.studies.bifurcation import DOWN, UP, Dwell, bifurcation

PAPER = pt.load_scene("paper")
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
