"""Speed and torque wander and ramp as stated, and the gearbox follows them."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.datasets.courses import commands_of, wander
from planetary_twin_py.datasets.plan import WANDERING
from planetary_twin_py.datasets.spec import STEP, Course

SCENE = pt.load_scene("paper").replace(**WANDERING)


def random(seed=1):
    return np.random.default_rng(seed)


def test_a_wander_has_the_autocorrelation_of_its_law():
    runs = np.array([wander(random(seed), 60, 0.2) for seed in range(1500)])
    error = 5.0 / math.sqrt(len(runs))
    assert np.abs(runs.mean(axis=0)).max() < error
    assert runs.var(axis=0) == pytest.approx(np.ones(60), abs=error * math.sqrt(2.0))
    for lag in (1, 10, 40):
        time = lag * STEP / 0.2
        expected = (1.0 + time) * math.exp(-time)
        assert (runs[:, 5] * runs[:, 5 + lag]).mean() == pytest.approx(expected, abs=error)


def test_a_ramp_has_the_mean_and_the_ends_of_the_record():
    course = commands_of(SCENE, Course(speed_ramp=0.2), 0.1, 0.5, random())
    speed = SCENE.operating_point.input_speed
    found = np.interp([0.05, 0.1, 0.3, 0.5], course.time, course.input_speed) / speed
    assert found == pytest.approx([0.95, 0.9, 1.0, 1.1], rel=1e-12)
    assert course.output_torque == pytest.approx(np.full(len(course), 147.0), rel=1e-12)


def test_the_gearbox_follows_speed_and_torque():
    """The sun turns with the input; the ring forces carry the torque of the output."""
    scene = SCENE.replace(**{"lubrication.friction": False})
    course = Course(speed_ramp=0.1, torque_wander=0.2)
    commands = commands_of(scene, course, 0.1, 0.39, random())
    run = pt.simulate(scene, 0.3, 20_000.0, settling=0.1, commands=commands)

    def slow(values):
        """Means over 0.1 s, several periods of the slowest mode of the train."""
        return np.convolve(values, np.full(2000, 1 / 2000), "valid")

    given = np.interp(run.time, commands.time, commands.input_speed)
    speed = run.speed[:, run.bodies.index("sun")]
    assert np.ptp(slow(given)) > 0.05 * given.mean()
    assert slow(speed) == pytest.approx(slow(given), rel=5e-3)
    torque = np.interp(run.time, commands.time, commands.output_torque)
    radius = 0.5 * 70 * 0.8e-3 * math.cos(math.radians(21.34))
    carried = radius * slow(run.mesh_force[:, 3:].sum(axis=1))
    assert np.ptp(slow(torque)) > 0.04 * torque.mean()
    assert np.corrcoef(carried, slow(torque))[0, 1] > 0.9
    assert carried.mean() == pytest.approx(slow(torque).mean(), rel=0.02)
