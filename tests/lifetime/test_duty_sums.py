"""Sums over a duty against closed forms."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from lifetime.power_map import PowerMap

import planetary_twin_py as pt
from planetary_twin_py.lifetime.duty_blocks import DAY, blocks_of
from planetary_twin_py.lifetime.duty_points import (
    compensated,
    covered_by,
    damage_of_points,
    points_of,
)
from planetary_twin_py.lifetime.duty_remarks import correlation_time, map_remarks, remarks_of
from planetary_twin_py.lifetime.duty_table import Duty
from planetary_twin_py.lifetime.excerpts import MapError
from planetary_twin_py.lifetime.steady_damage import Unsteady

SCENE = pt.load_scene("paper")
POWERS = PowerMap([6.61, 3.0])


def duty_of(torque, held=1.0, speed=100.0, time=True, **columns):
    count = len(torque)
    columns = {"input_torque": np.asarray(torque, float), **columns}
    columns["input_speed"] = np.broadcast_to(np.asarray(speed, float), (count,)).copy()
    held = np.broadcast_to(np.asarray(held, float), (count,)).copy()
    return Duty(held, columns, np.cumsum(held) - held if time else None)


def sums_of(duty):
    return compensated(damage_of_points(POWERS, points_of(SCENE, duty), len(duty.held)))


def test_damage_adds_up_over_rows_of_either_sign_and_rest():
    duty = duty_of([100.0, -50.0, 0.0, 100.0], held=[1.0, 2.0, 3.0, 4.0], speed=[10, 20, 30, 0])
    expected = 1e-9 * np.array([10.0 + 40.0 * 0.5**p for p in (6.61, 3.0)])
    np.testing.assert_allclose(sums_of(duty), expected, rtol=1e-12)


def test_scatter_within_a_row_costs_the_moment_of_a_normal_torque():
    steady = sums_of(duty_of([100.0]))
    ratio = sums_of(duty_of([100.0], input_torque_std=np.array([10.0]))) / steady
    assert ratio[0] == pytest.approx(1.193, abs=5e-4)
    assert ratio[1] == pytest.approx(1.0 + 3.0 * 0.01, rel=1e-12)  # third moment


def test_millions_of_small_rows_lose_no_digit():
    rows = np.full((1_000_000, 1), 0.1)
    rows[0] = 1e9
    assert compensated(rows)[0] == 1e9 + 99_999.9


def test_rows_outside_the_limits_of_the_scene_are_named():
    with pytest.raises(ValueError, match=r"^row 2: input_speed = 99999 rad/s: .*speed \[rpm\]"):
        points_of(SCENE, duty_of([1.0, 1.0], speed=[1.0, 99999.0]))
    wide = duty_of([900.0], input_torque_std=np.array([50.0]))
    with pytest.raises(ValueError, match=r"^row 1: input_torque with its scatter = 1018"):
        points_of(SCENE, wide)


def test_a_map_covers_what_turns_under_load():
    duty = duty_of([10.0, -80.0, 0.0, 99.0], speed=[100.0, -50.0, 400.0, 0.0])
    found = covered_by(points_of(SCENE, duty))
    assert (found.torque, found.speed) == (80.0, (50.0, 100.0))
    with pytest.raises(ValueError, match="never turns under a torque"):
        covered_by(points_of(SCENE, duty_of([0.0, 10.0], speed=[100.0, 0.0])))


def test_days_are_blocks_and_a_mission_is_one():
    torque = np.ones(4 * 24)
    duty = duty_of(torque, held=3600.0)
    damage = np.ones((96, 1))
    days, unknown = blocks_of(duty, damage, None)
    np.testing.assert_allclose(days.damage[:, 0], 24.0)
    assert not unknown and np.all(days.length == DAY)
    thirds, _ = blocks_of(duty, damage, 32 * 3600.0)
    np.testing.assert_allclose(thirds.damage[:, 0], 32.0)
    whole, unknown = blocks_of(duty_of(torque, held=60.0), damage, None)
    assert len(whole.length) == 1 and "one block" in unknown[0]
    with pytest.raises(ValueError, match="at most"):
        blocks_of(duty, damage, 3 * DAY)
    with pytest.raises(ValueError, match="column time"):
        blocks_of(duty_of(torque, time=False), damage, DAY)


def test_rows_of_minutes_lack_the_scatter_within_them():
    oil = np.full(3, 340.0)
    coarse = duty_of([1.0, 2.0, 3.0], held=600.0, oil_temperature=oil)
    (line,) = remarks_of(SCENE, coarse, 6.61)
    assert "rows of 600 s" in line and "p = 6.61" in line and "1.19 for s = 0.1" in line
    known = duty_of([1.0, 2.0, 3.0], held=600.0, oil_temperature=oil, input_torque_std=0.1 * oil)
    assert not [*remarks_of(SCENE, known, 6.61)]


def test_torque_faster_than_half_a_second_is_named():
    time = 0.01 * np.arange(4000)
    found = {}
    for period in (0.5, 8.0):
        duty = duty_of(50.0 + np.sin(2.0 * math.pi * time / period), held=0.01)
        found[period] = [line for line in remarks_of(SCENE, duty, 6.61) if "faster" in line]
        exact = period * math.acos(math.exp(-1.0)) / (2.0 * math.pi)
        assert correlation_time(duty) == pytest.approx(exact, rel=0.05)
    assert found[0.5] and not found[8.0]


def test_doubts_about_a_map_are_named():
    table = SimpleNamespace(
        parts=("sun_root",), extrapolated=("sun_root",), runs=9,
        unsteady=(Unsteady(5.0, 100.0, 343.15, 0.05),),
    )  # fmt: skip
    for bound, count in ((0.004, 2), (0.01, 3), (math.nan, 3)):
        error = MapError(np.array([-0.015]), np.array([bound]), 16, 1.0)
        lines = [*map_remarks(table, error, "sun_root")]
        assert len(lines) == count
        assert lines[0].startswith("sun_root: stresses above the first point")
        assert math.isfinite(bound) or "unknown for sun_root" in lines[2]
        assert lines[1].startswith("1 of 9 runs of the map do not become steady")
    assert len([*map_remarks(table, error, "")]) == 2
