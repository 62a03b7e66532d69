"""Transmission error of counts and of the model."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.following.train import followed_train
from planetary_twin_py.following.transmission_error import ErrorOfCounts, model_error

N = 2**20


@pytest.mark.parametrize("turns", [0, 10**3, 10**6, -(10**6)])
def test_counts_give_the_twist_at_any_age(turns):
    train = followed_train(pt.load_scene("paper"))
    convert = ErrorOfCounts(train, (N, N))
    sun = N * (7 * turns + np.arange(5)) + 12345
    ring = -(sun - 12345) * 3 // 7
    back = np.array([0, 1, 2, 30, -7])  # counts by which the ring lags
    zero = (12345, 0)
    found = convert(np.stack([sun, ring + back], axis=1), zero)
    thirds = 3 * (sun - 12345) + 7 * (ring + back)  # of counts of the sun, exact
    twist = thirds / 3.0 * 2.0 * np.pi / N
    assert found.error == pytest.approx(train.lever * twist, abs=1e-12)
    place = 30 * (sun / N)
    assert found.cycle + found.part == pytest.approx(place, rel=1e-12)


def test_error_of_model_grows_with_the_torque_as_the_teeth_yield():
    scene = pt.load_scene("paper")
    light, heavy = (
        float(np.mean(model_error(scene.replace(input_torque=t), 30, 50, 0.1, 1e-5)[1]))
        for t in (40.0, 80.0)
    )
    radius = followed_train(scene).lever
    force = (
        40.0 / radius / 3.0
    )  # more on each of three sun meshes, and on the ring meshes in series
    stiff, soft = 2e8 * 1.75, 2e8
    assert 2.0 * force / stiff < heavy - light < 2.0 * force / soft


def test_the_model_is_sampled_by_the_angle_of_its_sun():
    scene = pt.load_scene("paper")
    first, error = model_error(scene, 4, 50, 0.1, 1e-5)
    run = pt.simulate(scene, 0.2, 1e5, tolerance=1e-5)
    sun, ring = (run.angle[:, run.bodies.index(body)] for body in ("sun", "ring"))
    place = 30.0 * sun / (2.0 * np.pi)
    own = np.interp((first + np.arange(200)) / 50, place, sun + 7.0 / 3.0 * ring)
    twisted = 63.0 / 500.0 / (2.0 * np.pi)  # turns by which the coupling lets the sun lag
    assert len(error) == 200
    assert first == pytest.approx(50 * 30 * (0.1 * 1000 / 60 - twisted), abs=3)
    lever = followed_train(scene).lever
    assert error == pytest.approx(lever * own, abs=1e-7)  # linear between points
