"""Estimates of the COMPAct rig's losses against plain regression, and the scene that has them."""

import numpy as np
import pytest

import planetary_twin_py as pt


@pytest.fixture
def losses(measured):
    return measured("compact_losses")


@pytest.mark.exhaustive
@pytest.mark.slow
def test_the_packaged_scene_has_the_estimates_of_all_steady_runs(losses):
    points, base, slopes = losses.steady()
    found = losses.estimate(points.loss, base, slopes)
    scene = pt.load_scene("compact_actuator")
    assert scene.lubrication.boundary_coefficient == pytest.approx(found.values[0], rel=2e-3)
    assert scene.losses.sun_drag.coulomb == pytest.approx(found.values[1], rel=2e-3)


@pytest.mark.exhaustive
@pytest.mark.slow
def test_the_twin_is_the_straight_line_through_the_readings(losses):
    points, base, _ = losses.steady()
    straight = np.polyval(np.polyfit(points.torque, points.loss, 1), points.torque)
    assert len(points.loss) == 54
    assert np.sqrt(np.mean((base - straight) ** 2)) < 0.02


@pytest.mark.slow
def test_intervals_from_two_speeds_hold_the_losses_at_the_third(losses):
    points, base, slopes = losses.steady()
    for speed in (10.0, 20.0, 30.0):
        out = np.round(points.speed, -1) == speed
        found = losses.estimate(points.loss[~out], base[~out], slopes[~out])
        predicted, reach = losses.prediction(found, base[out], slopes[out])
        assert np.mean(np.abs(predicted - points.loss[out]) <= reach) >= 0.9
        assert reach.max() < 0.1
