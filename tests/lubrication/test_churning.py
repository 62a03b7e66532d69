"""Drag of a disc against the coefficients of Daily and Nece, and its growth with the speed."""

import math

import numpy as np
import pytest
from planetary_twin_core_parts import disc_torque

RADIUS, GAP, DENSITY = 0.1, 0.05, 890.0


def coefficient(reynolds, nu=1e-4):
    speed = reynolds * nu / RADIUS**2
    torque = disc_torque(RADIUS, GAP, DENSITY, nu, speed)
    return torque / (0.5 * DENSITY * speed**2 * RADIUS**5)


@pytest.mark.parametrize(
    "reynolds, expected",
    [
        (100.0, 2 * math.pi / (GAP * 100.0)),
        (1e5, 3.7 * GAP**0.1 * 1e5**-0.5),
        (1e7, 0.102 * GAP**0.1 * 1e7**-0.2),
    ],
)
def test_coefficient_in_three_regimes(reynolds, expected):
    assert coefficient(reynolds) == pytest.approx(expected, rel=2e-3)


def test_a_narrow_gap_is_turbulent_with_merged_layers():
    nu, speed = 1e-4, 1e5 * 1e-4 / RADIUS**2
    torque = disc_torque(RADIUS, 0.01, DENSITY, nu, speed)
    expected = 0.08 * 0.01 ** (-1 / 6) * 1e5**-0.25
    assert torque / (0.5 * DENSITY * speed**2 * RADIUS**5) == pytest.approx(expected, rel=2e-3)


def test_torque_vanishes_at_rest_and_only_grows():
    speeds = np.linspace(0.0, 500.0, 400)
    torques = [disc_torque(RADIUS, GAP, DENSITY, 1e-4, w) for w in speeds]
    assert torques[0] == 0.0
    assert np.diff(torques).min() > 0.0
    assert disc_torque(RADIUS, GAP, DENSITY, 1e-4, -50.0) == disc_torque(
        RADIUS, GAP, DENSITY, 1e-4, 50.0
    )
