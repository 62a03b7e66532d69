"""Runs whose motion outgrows their tolerance say so, and others say nothing."""

import warnings

import pytest

import planetary_twin_py as pt

PAPER = pt.load_scene("paper")
RATTLE = {
    "input_speed": 1100.0,
    "input_torque": 5.0,
    "backlash": 1e-6,
    "mesh.damping.law": "viscous",
    "mesh.damping.damping_ratio": 0.01,
}
STOPPING = {
    "input_speed": pt.rpm(100),
    "input_torque": 260.0,
    "mesh.double_pair_ratio": 1.9,
    "mesh.damping.law": "viscous",
    "mesh.ramp": 0.0,
}


@pytest.mark.parametrize(
    "changes", [{}, {"input_speed": 0.0}, {"dynamics": "quasi_static", "input_speed": 0.01}]
)
def test_a_run_that_keeps_to_its_tolerance_is_not_warned_of(changes):
    with warnings.catch_warnings():
        warnings.simplefilter("error", pt.AccuracyWarning)
        pt.simulate(PAPER.replace(**changes), 0.02)


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"input_speed": pt.rpm(0.01)}, "the gears creep, and roll by"),
        (RATTLE, "flanks engage and separate"),
        (STOPPING, "vibration stops gears"),
    ],
)
def test_a_run_that_may_not_keep_to_it_says_why(changes, reason):
    with pytest.warns(pt.AccuracyWarning, match=reason):
        pt.simulate(PAPER.replace(**changes), 0.02)


def test_creeping_gears_are_not_warned_of_once_they_have_rolled_far_enough():
    scene = PAPER.replace(input_speed=pt.rpm(5))
    with warnings.catch_warnings():
        warnings.simplefilter("error", pt.AccuracyWarning)
        pt.simulate(scene, 0.1)
    with pytest.warns(pt.AccuracyWarning, match=r"simulate 0\.\d+ s"):
        pt.simulate(scene, 0.001)
