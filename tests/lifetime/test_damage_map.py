"""The map of damage between its nodes, against a closed form in place of runs."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.durability.strength import FLANK
from planetary_twin_py.lifetime import damage_map
from planetary_twin_py.lifetime.damage_map import make_damage_map
from planetary_twin_py.lifetime.map_axes import MapRange
from planetary_twin_py.lifetime.passages import passages_per_turn
from planetary_twin_py.lifetime.steady_damage import SteadyDamage

SCENE = pt.load_scene("paper").replace(durability={})
RANGE = MapRange(100.0, (50.0, 200.0), (320.0, 360.0))
RESONANCE, RATIO = 110.0, 0.05
CURVE = FLANK["case_hardened"].curve(1.5e9)
RANDOM = np.random.default_rng(0)
PASSAGES = max(map(float, passages_per_turn(SCENE)["sun_flank_drive"])) / (2.0 * math.pi)


def per_radian(torque, speed, heat):
    """Damage of the sun over angle: stress with a resonance, on both parts of its S-N curve."""
    over = (np.abs(speed) / RESONANCE) ** 2
    amplitude = 1.0 + 0.02 / np.sqrt((1.0 - over) ** 2 + 4.0 * RATIO**2 * over)
    stress = 1.5e9 * np.sqrt(np.abs(torque) / 60.0) * amplitude * np.exp(1e-3 * (heat - 340.0))
    return PASSAGES / CURVE.life(stress)


@pytest.fixture
def closed_form(monkeypatch):
    """Runs of the nodes, which have the closed form."""
    runs = []

    def found(scene):
        point = scene.operating_point
        runs.append(point)
        damage = per_radian(point.input_torque, point.input_speed, point.oil_temperature)
        drives = point.input_torque > 0.0
        carries = [drives if "drive" in part else not drives for part in PARTS]
        return SteadyDamage(damage * np.array(carries), np.zeros(len(PARTS)))

    PARTS = make_damage_map(SCENE).parts
    monkeypatch.setattr(damage_map, "steady_damage", found)
    return runs


def points(count):
    return (
        RANDOM.uniform(30.0, 100.0, count) * RANDOM.choice([-1.0, 1.0], count),
        RANDOM.uniform(90.0, 130.0, count),
        RANDOM.uniform(335.0, 345.0, count),
    )


def test_rates_between_the_nodes_are_those_of_the_closed_form(closed_form):
    table = make_damage_map(SCENE, MapRange(100.0, (90.0, 130.0), (335.0, 345.0)))
    torque, speed, heat = points(1000)
    exact = per_radian(torque, speed, heat) * np.abs(speed)
    rates = table.rates(torque, speed, heat)
    drive, coast = (table.parts.index(f"sun_flank_{name}") for name in ("drive", "coast"))
    found = rates[:, drive] + rates[:, coast]
    error = np.abs(found / exact - 1.0)
    assert error.max() < 1.005 ** CURVE.exponent(1) - 1.0  # 0.5 % of stress, at the resonance
    assert np.quantile(error, 0.5) < 0.01
    assert found.sum() == pytest.approx(exact.sum(), rel=0.01)
    assert np.all(rates[torque > 0.0, coast] == 0.0) and np.all(rates[torque < 0.0, drive] == 0.0)
    assert table.runs == len(closed_form)


def test_only_the_nodes_around_a_point_are_computed_once(closed_form):
    table = make_damage_map(SCENE, RANGE)
    first = table.rates(40.0, 100.0, 340.0)
    count = len(closed_form)
    assert count <= 4 * 4 * 3
    np.testing.assert_array_equal(table.rates([40.0, 41.0], 100.0, 340.0)[0], first)
    assert len(closed_form) == count


def test_no_torque_and_no_rotation_do_no_damage(closed_form):
    table = make_damage_map(SCENE, RANGE)
    assert not table.rates([0.0, 50.0, 0.0], [100.0, 0.0, 0.0], 340.0).any()
    assert not closed_form


def test_light_torque_follows_its_power_and_slow_turns_do_the_same(closed_form):
    table = make_damage_map(SCENE, RANGE)
    place = table.parts.index("sun_flank_drive")
    light = table.rates(np.array([0.5, 1.0]), 100.0, 340.0)[:, place]
    assert light[1] / light[0] == pytest.approx(2.0 ** (0.5 * CURVE.exponent(1)))
    slow = table.rates(50.0, np.array([50.0, 5.0]), 340.0)[:, place]
    assert slow[0] / slow[1] == pytest.approx(10.0)


@pytest.mark.parametrize(
    ("at", "reason"),
    [
        ((101.0, 100.0, 340.0), "input_torque = 101 N m: must be within -100 and 100 N m"),
        ((50.0, -201.0, 340.0), "input_speed = -201 rad/s: must be within -200 and 200 rad/s"),
        ((50.0, 100.0, 361.0), "oil_temperature = 361 K: must be within 320 and 360 K"),
        ((math.nan, 100.0, 340.0), "input_torque = nan N m"),
    ],
)
def test_what_is_outside_the_map_is_refused_in_one_line(closed_form, at, reason):
    table = make_damage_map(SCENE, RANGE)
    with pytest.raises(ValueError, match=reason) as refusal:
        table.rates(*at)
    assert "\n" not in str(refusal.value)
    assert table.outside(*at) and not table.outside(50.0, 100.0, 340.0)


def test_a_scene_without_a_section_or_with_two_motors_is_refused():
    with pytest.raises(pt.SceneError, match=r"^durability: missing"):
        make_damage_map(pt.load_scene("paper"))
    with pytest.raises(pt.SceneError, match=r"drive\.second_input"):
        make_damage_map(pt.load_scene("differential").replace(durability={}))
