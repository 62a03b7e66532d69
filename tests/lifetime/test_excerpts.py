"""The map of damage against direct runs of whole duties, and the error that it states."""

import math
from functools import cache

import numpy as np
import pytest
from lifetime.stages import stage

import planetary_twin_py as pt
from planetary_twin_py.lifetime.damage_map import make_damage_map
from planetary_twin_py.lifetime.duty_points import (
    compensated,
    covered_by,
    damage_of_points,
    points_of,
)
from planetary_twin_py.lifetime.duty_table import Duty
from planetary_twin_py.lifetime.excerpts import _drawn, _judged, map_error

STEP = 0.01  # [s] of the rows
LEAD = 100  # rows before the duty, in which the start decays
SECONDS = 6.0

pytestmark = pytest.mark.slow


def course(scene, deviation, slowest, fastest):
    """Sum of sines of random phases with periods from `fastest` to `slowest` [s]."""
    chance = np.random.default_rng(5)
    time = STEP * np.arange(round(SECONDS / STEP) + LEAD)
    sines = [
        np.sin(2.0 * math.pi * (time / period + chance.random()))
        for period in np.geomspace(fastest, slowest, 7)
    ]
    wave = np.sum(sines, axis=0) / math.sqrt(3.5)
    point = scene.operating_point
    torque = point.input_torque * (1.0 + deviation * wave)
    columns = {"input_torque": torque, "input_speed": np.full(len(time), point.input_speed)}
    return Duty(np.full(len(time), STEP), columns, time)


def directly(scene, duty):
    """Damage of the rows after the lead, with the torque of the input, the speed of the output."""
    ports = {
        "drive.input.port": "torque",
        "drive.output.port": "motion",
        "drive.interpolation": "linear",
    }
    torque = duty.columns["input_torque"]
    twin = pt.Twin(scene.replace(input_torque=float(torque[0]), **ports), 100.0, 1e-6)
    total = 0.0
    for row, after in enumerate(torque[1:]):
        found = twin.advance(STEP, input_torque=float(after)).damage.damage
        total = total + (found if row >= LEAD else 0.0)
    return total


def of_map(scene, duty, excerpts=8):
    points = points_of(scene, duty)
    table = make_damage_map(scene, covered_by(points))
    rows = damage_of_points(table, points, len(duty.held))
    error = map_error(scene, table, duty, points, excerpts)
    return table.parts, rows, error


CASES = {
    "slow": ("helicopter_stage", 0.1, 8.0, 1.5),
    "fast": ("helicopter_stage", 0.2, 4.0, 0.3),
    "e_axle": ("e_axle", 0.2, 6.0, 1.5),
}


@cache
def compared(case):
    """Difference of map and direct run, and the stated error, for the part that fails first."""
    name, deviation, slowest, fastest = CASES[case]
    scene = stage(name)
    duty = course(scene, deviation, slowest, fastest)
    parts, rows, error = of_map(scene, duty)
    found = compensated(rows[LEAD:-1])
    exact = directly(scene, duty)
    place = int(np.argmax(exact))
    assert parts[place].startswith(("sun_flank", "sun_root"))
    return found[place] / exact[place] - 1.0, error.largest[place]


@pytest.mark.parametrize("case", CASES)
def test_map_and_direct_run_differ_by_the_stated_error(case):
    difference, stated = compared(case)
    assert abs(difference) <= stated


@pytest.mark.parametrize("case", CASES)
def test_the_stated_error_is_small(case):
    assert compared(case)[1] < 0.02


def test_a_steady_duty_has_the_error_of_the_interpolation():
    scene = stage("helicopter_stage").replace(dynamics="quasi_static")
    columns = {
        "input_torque": np.array([1300.0, 1000.0, 700.0, -900.0]),
        "input_speed": pt.rpm(np.array([1600.0, 1200.0, 2000.0, 1500.0])),
    }
    duty = Duty(np.full(4, 600.0), columns, 600.0 * np.arange(4))
    _, rows, error = of_map(scene, duty, 6)
    assert rows.max(axis=1).all()
    assert math.isnan(error.seconds)
    assert np.nanmax(error.largest) < 0.02


def test_the_interval_of_the_error_has_the_true_one_in_19_of_20_choices():
    """Windows whose map is off by known factors: the error of their sum, and its intervals."""
    chance = np.random.default_rng(2)
    mapped = chance.lognormal(0.0, 1.0, (300, 1))
    direct = mapped * chance.normal(1.05, 0.05, (300, 1))
    exact = mapped.sum() / direct.sum() - 1.0
    both, held = np.stack([mapped, direct], axis=1), np.array([True])
    inside = 0
    for seed in range(400):
        picks, weights = _drawn(mapped, held, 16, seed)
        found = _judged(both[picks], weights, 16, 1.0)
        inside += abs(found.mean[0] - exact) <= found.bound[0]
    assert 0.92 <= inside / 400 <= 0.99
