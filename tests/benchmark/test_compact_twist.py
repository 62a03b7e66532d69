"""Lost motion and stiffness computed from the readings of the COMPAct rig."""

import math

import numpy as np
import pytest


@pytest.fixture
def rig(measured):
    return measured("compact_twist")


def test_lost_motion_is_that_of_the_authors(rig):
    assert math.degrees(rig.lost_motion_in(0.0, 1.0)) == pytest.approx(0.591, abs=5e-4)


def test_the_output_rests_nearer_than_its_range(rig):
    low, high = rig.resting_places()
    assert 0.0 < high - low < 0.6 * rig.lost_motion_in(0.0, 1.0)


def test_the_chord_is_that_of_the_largest_torques(rig):
    loop = rig.twist_loop()
    assert loop.chord == pytest.approx(40.0 / (0.6844 + 0.6720), rel=0.02)
    assert loop.slope < loop.chord < loop.loading < loop.unloading
    assert rig.RATIO * loop.chord == pytest.approx(242.7, rel=0.15)  # as published


def test_a_straight_spring_has_its_stiffness(rig):
    torque = np.linspace(-20.0, 20.0, 101)
    assert rig._stiffness(torque, torque / 30.0) == pytest.approx(30.0)
