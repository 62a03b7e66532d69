"""Damage of steady running against runs that are many times as long."""

import numpy as np
import pytest
from lifetime.stages import stage

import planetary_twin_py as pt
from planetary_twin_py.lifetime.steady_damage import (
    TOLERANCE,
    Unsteady,
    damage_of,
    steady_damage,
    steady_scene,
    unsteady_remark,
)


def long_mean(scene, lead, duration):
    twin = pt.Twin(scene, 10.0, TOLERANCE)
    damage_of(twin, lead)
    return damage_of(twin, duration) / (scene.operating_point.input_speed * duration)


@pytest.mark.parametrize(
    "name", ["paper", "cracked_tooth", pytest.param("lightly_loaded", marks=pytest.mark.slow)]
)
def test_a_motion_that_repeats_has_the_damage_of_a_long_run(name):
    scene = pt.load_scene(name).replace(durability={})
    found = steady_damage(scene)
    exact = long_mean(scene, 1.8, 0.9)
    worst = int(np.argmax(exact))
    assert found.doubt == 0.0
    assert found.per_angle[worst] == pytest.approx(exact[worst], rel=0.01)


def test_a_motion_that_does_not_repeat_has_a_mean_within_its_interval(monkeypatch):
    """Blocks too short for the slow oscillation of this axle: it never repeats from one to one."""
    monkeypatch.setattr("planetary_twin_py.lifetime.steady_damage.SAME", 1e-7)
    scene = stage("e_axle").replace(input_torque=120.0)
    found = steady_damage(scene)
    exact = long_mean(scene, 1.0, 3.0)
    worst = int(np.argmax(exact))
    assert 0.0 < found.doubt < 0.02
    assert abs(found.per_angle[worst] / exact[worst] - 1.0) <= found.doubt


def test_steps_are_short_enough_for_peaks_that_count_with_a_high_power():
    """An axle whose steps at a tolerance of 1e-4 miss 5 % of the damage."""
    scene = stage("e_axle")
    scene = scene.replace(input_speed=0.9 * scene.operating_point.input_speed)
    found = steady_damage(scene)
    twin = pt.Twin(scene, 10.0, 1e-8)
    damage_of(twin, 0.2)
    exact = damage_of(twin, 0.05) / (scene.operating_point.input_speed * 0.05)
    worst = int(np.argmax(exact))
    assert found.per_angle[worst] == pytest.approx(exact[worst], rel=0.02)


@pytest.mark.slow
def test_pits_in_bearings_which_never_repeat_have_a_mean():
    rollers = {"mass": 0.177, "rolling": {"rollers": 14, "length": 0.012}}
    pit = {"kind": "bearing", "element": "inner", "ratio": 0.2, "depth": 1e-6}
    whole = pt.load_scene("floating_sun").replace(durability={}, **{"supports.planet": rollers})
    found, sound = (steady_damage(scene) for scene in (whole.replace(faults=[pit]), whole))
    worst = int(sound.per_angle.argmax())
    assert found.per_angle[worst] == pytest.approx(sound.per_angle[worst], rel=0.2)


def test_a_start_from_rest_and_temperatures_are_left_out():
    scene = pt.load_scene("run_up").replace(durability={})
    assert scene.drive.speed_control.start_speed is not None
    at = {"input_torque": 40.0, "input_speed": 100.0}
    found = steady_damage(steady_scene(scene, **at))
    plain = scene.replace(**{"drive.speed_control.start_speed": None})
    np.testing.assert_array_equal(found.per_angle, steady_damage(plain.replace(**at)).per_angle)


def test_the_least_certain_run_is_named():
    runs = [Unsteady(5.0, 100.0, 343.15, 0.01), Unsteady(7.0, 50.0, 343.15, 0.031)]
    assert unsteady_remark(runs, 40) == (
        "2 of 40 runs of the map do not become steady, and count with their mean damage: the least "
        "certain one, at 7 N m, 50 rad/s and 70 degC, within +- 3.1 % (95 %)"
    )
    assert unsteady_remark([], 40) is None
