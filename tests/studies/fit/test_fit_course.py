"""Manoeuvres: friction, drag and inertia of a plant, and of readings of a test rig."""

from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

import planetary_twin_py as pt
from planetary_twin_py.following.loss_map import LossMap
from planetary_twin_py.following.train import followed_train
from planetary_twin_py.studies.fit.fit_course import course_remarks, fit_course

RIG = Path(__file__).parents[2] / "data/compact"
FRICTION, DRAG = "lubrication.boundary_coefficient", "losses.sun_drag.coulomb"
MOTOR = "drive.input.inertia"
NOISE = 0.01  # [N m] of the torque at the input
RATE = 50.0  # [Hz]
SCENE = pt.load_scene("compact_actuator").replace(**{MOTOR: 2e-3})


def manoeuvre(path, kind, slow_error=0.0, seed=0):
    """Readings of a gearbox with friction 0.5, drag 0.05 N m and another motor."""
    true = SCENE.replace(**{FRICTION: 0.5, DRAG: 0.05, MOTOR: 3e-3})
    train, losses = followed_train(true), LossMap(true)
    time = np.arange(1, 1001) / RATE
    if kind == "reversal":
        speed = 20.0 * np.cos(2.0 * np.pi * time / 10.0)
        torque = np.sign(speed) * np.where(np.sin(2.0 * np.pi * time / 7.0) > 0.0, 1.5, 0.7)
    else:  # run-up
        speed, torque = 2.0 + 1.5 * time, 0.5 + 0.05 * time
    acceleration = np.gradient(speed, time)
    lost = np.sign(speed) * losses(torque, speed, train.oil_temperature).total
    noise = np.random.default_rng(seed)
    savemat(
        path,
        {
            "time": time,
            "input_torque": torque + train.inertia * acceleration
            + NOISE * noise.standard_normal(len(time)) + slow_error * np.sin(time),
            "output_torque": (lost - torque) / train.ratio,
            "input_speed": speed,
        },
    )  # fmt: skip
    return path


@pytest.mark.exhaustive
def test_a_reversal_determines_friction_drag_and_inertia(tmp_path):
    path = manoeuvre(tmp_path / "rig.mat", "reversal")
    found = fit_course(path, SCENE, (FRICTION, DRAG, MOTOR), hold_out=(15.0, 20.0), span=(0, 14.9))
    for (low, high, _), true in zip(found.estimate.intervals, (0.5, 0.05, 3e-3), strict=True):
        assert low < true < high
    assert found.estimate.values[2] == pytest.approx(3e-3, rel=0.1)
    assert found.inside >= 0.9
    assert list(course_remarks(found)) == []


@pytest.mark.exhaustive
def test_a_slow_error_is_remarked_upon_and_widens_the_intervals(tmp_path):
    clean, wrong = (
        fit_course(manoeuvre(tmp_path / "rig.mat", "run-up", error), SCENE, (DRAG,))
        for error in (0.0, 0.05)
    )
    assert any("residuals are not noise" in line for line in course_remarks(wrong))
    widths = [one.estimate.intervals[0].high - one.estimate.intervals[0].low
              for one in (clean, wrong)]  # fmt: skip
    assert widths[1] > 3.0 * widths[0]


@pytest.mark.exhaustive
def test_a_run_of_the_rig_predicts_its_end():
    scene = pt.load_scene("compact_actuator")
    found = fit_course(
        RIG / "ramp.parquet", scene, (FRICTION, DRAG), span=(1.0, 20.0), hold_out=(20.2, 34.0)
    )
    assert 0.9 <= found.inside <= 1.0
    low, high, _ = found.estimate.intervals[1]
    assert low < scene.losses.sun_drag.coulomb < high  # estimated from steady runs
    assert found.estimate.values[0] == pytest.approx(0.825, rel=0.1)
    assert found.simulations < 60


def test_a_part_that_overlaps_is_refused(tmp_path):
    path = manoeuvre(tmp_path / "rig.mat", "run-up")
    with pytest.raises(ValueError, match="overlaps the fitted part"):
        fit_course(path, SCENE, (DRAG,), span=(0.0, 15.0), hold_out=(10.0, 20.0))


@pytest.mark.filterwarnings("error")
def test_a_parameter_without_effect_is_reported_with_the_reason(tmp_path):
    scene = pt.load_scene("paper")
    train, losses = followed_train(scene), LossMap(scene)
    time, one = np.arange(1, 301) / RATE, np.ones(300)
    lost = losses(63.0, pt.rpm(1000), train.oil_temperature).total
    torque = 63.0 + NOISE * np.random.default_rng(1).standard_normal(len(time))
    table = {"time": time, "input_speed": pt.rpm(1000) * one, "input_torque": torque}
    savemat(tmp_path / "rig.mat", table | {"output_torque": (lost - 63.0) / train.ratio * one})
    found = fit_course(tmp_path / "rig.mat", scene, ("mesh.damping.damping_ratio",))
    (line,) = course_remarks(found)
    assert "the simulated torque does not change with it" in line
    with pytest.raises(
        ValueError, match=r"lubrication\.boundary = greenwood_tripp does not use it"
    ):
        fit_course(tmp_path / "rig.mat", scene, (FRICTION,))
