"""Damage of real gearboxes from their readings, against sums in closed form."""

import math
from itertools import pairwise

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.durability.damage_state import DamageState
from planetary_twin_py.durability.parts import part_names
from planetary_twin_py.durability.state_text import parse_state, state_text
from planetary_twin_py.following.damage.counter import DamageCounter
from planetary_twin_py.following.damage.remarks import damage_remarks

from ..power_map import EXPONENTS, MOST, PARTS, SCENE, PowerMap, expected_rates

SPEED, OIL = 104.7, 343.15
CHANCE = np.random.default_rng(3)
COUNT = 3000
TIME = 0.1 * np.arange(COUNT)
TORQUE = 60.0 + 12.0 * CHANCE.standard_normal(COUNT)
TORQUE[1000:1100] *= -1.0
READINGS = {
    "input_torque": TORQUE, "input_speed": SPEED + CHANCE.standard_normal(COUNT),
    "oil_temperature": OIL + 0.01 * np.arange(COUNT),
}  # fmt: skip


def counter(state=None, count=1, **options):
    states = [state or DamageState(PARTS)] if count == 1 else [DamageState(PARTS)] * 0
    states = states or [DamageState(PARTS) for _ in range(count)]
    return DamageCounter(SCENE, PowerMap(), states, **options)


def fed(time, columns, state=None, cuts=()):
    """A counter of one gearbox with readings in parts."""
    made = counter(state)
    bounds = [0, *cuts, len(time)]
    for a, b in pairwise(bounds):
        made.add(time[a:b], {name: values[a:b, None] for name, values in columns.items()})
    return made


def test_sums_are_those_of_rates_times_steps():
    made = fed(TIME, READINGS)
    state, counted = made.state(), np.abs(TORQUE[1:]) <= MOST
    rates = expected_rates(TORQUE[1:], READINGS["input_speed"][1:])
    steps = np.diff(TIME)
    expected = (rates * steps[:, None])[counted].sum(axis=0)
    assert state.sums == pytest.approx(expected, rel=1e-12)
    assert state.hours * 3600.0 == pytest.approx(steps[counted].sum(), rel=1e-12)
    outside = float(state.times.outside.total)
    assert outside == pytest.approx(steps[~counted].sum()) and outside > 0.0
    assert state.readings.counted + state.readings.outside == COUNT - 1
    mean = np.average(READINGS["oil_temperature"][1:][counted], weights=steps[counted])
    assert state.mean_oil_temperature == pytest.approx(mean, rel=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_any_split_gives_the_same_file_bit_for_bit(seed):
    whole = state_text(fed(TIME, READINGS).state(), SCENE)
    cuts = np.sort(np.random.default_rng(seed).integers(0, COUNT, 40))
    assert state_text(fed(TIME, READINGS, cuts=cuts).state(), SCENE) == whole


@pytest.mark.parametrize("seed", range(4))
def test_any_number_of_restarts_gives_the_same_file_bit_for_bit(seed):
    whole = state_text(fed(TIME, READINGS).state(), SCENE)
    cuts = [0, *np.sort(np.random.default_rng(seed).integers(0, COUNT, 12)), COUNT]
    text = state_text(DamageState(PARTS), SCENE)
    for a, b in pairwise(cuts):
        part = {name: values[a:b] for name, values in READINGS.items()}
        text = state_text(fed(TIME[a:b], part, parse_state(text, SCENE, PARTS)).state(), SCENE)
    assert text == whole


def test_readings_that_are_read_again_are_not_counted_twice():
    once = state_text(fed(TIME, READINGS).state(), SCENE)
    again = fed(TIME, READINGS, parse_state(once, SCENE, PARTS))
    assert state_text(again.state(), SCENE) == once
    assert f"{COUNT} readings are not later" in next(iter(damage_remarks(again)))
    half = COUNT // 2
    part = {name: values[:half] for name, values in READINGS.items()}
    first = parse_state(state_text(fed(TIME[:half], part).state(), SCENE), SCENE, PARTS)
    assert state_text(fed(TIME, READINGS, first).state(), SCENE) == once


def test_a_gap_is_unknown_time_and_no_damage():
    late = TIME + np.where(np.arange(COUNT) >= 1500, 3600.0, 0.0)
    made = fed(late, READINGS)
    state, whole = made.state(), fed(TIME, READINGS).state()
    assert float(state.times.unknown.total) == pytest.approx(3600.1)
    missing = expected_rates(TORQUE[1500], READINGS["input_speed"][1500]) * 0.1
    assert state.sums == pytest.approx(whole.sums - missing, rel=1e-9)
    assert any("1 gaps between readings, the longest of 3600 s" in x for x in damage_remarks(made))


def test_missing_torques_become_a_gap_not_zero_damage():
    columns = {**READINGS, "input_torque": TORQUE.copy()}
    columns["input_torque"][1000:1100] = np.nan  # 10 s
    state = fed(TIME, columns).state()
    assert float(state.times.unknown.total) == pytest.approx(10.1)


@pytest.mark.parametrize("step", [1.0, 10.0, 600.0])
def test_slow_rows_are_no_gaps_from_the_second_on(step):
    time = step * np.arange(30)
    columns = {name: np.full(30, v) for name, v in (("input_torque", 60.0), ("input_speed", SPEED))}
    state = fed(time, columns).state()
    first = 0.0 if step <= 2.0 else step
    assert float(state.times.unknown.total) == pytest.approx(first)
    assert state.hours * 3600.0 == pytest.approx(29 * step - first)


def test_readings_outside_the_map_are_named_with_their_time():
    torque = np.full(100, 60.0)
    torque[[40, 70]] = 150.0, -120.0
    columns = {"input_torque": torque, "input_speed": np.full(100, SPEED)}
    made = fed(TIME[:100], columns)
    state = made.state()
    assert state.readings.outside == 2
    assert state.readings.first_outside == TIME[40]
    assert float(state.times.outside.total) == pytest.approx(0.2)
    line = next(line for line in damage_remarks(made) if "outside" in line)
    assert "2 readings" in line and "at 4.0 s" in line and "150 N m" in line
    inside = np.delete(np.arange(1, 100), [39, 69])
    expected = (expected_rates(torque, SPEED)[inside] * 0.1).sum(axis=0)
    assert state.sums == pytest.approx(expected, rel=1e-9)


def test_a_reading_for_which_a_run_fails_is_left_out_alone():
    class Failing(PowerMap):
        def rates(self, torque, speed, temperature):
            if (np.abs(torque) > 80.0).any():
                raise ValueError("stress is above its curve")
            return super().rates(torque, speed, temperature)

    torque = np.full(50, 60.0)
    torque[20] = 85.0
    made = DamageCounter(SCENE, Failing(), [DamageState(PARTS)])
    columns = {"input_torque": torque[:, None], "input_speed": np.full((50, 1), SPEED)}
    made.add(TIME[:50], columns)
    assert made.state().readings.counted == 48 and made.state().readings.outside == 1
    assert any("stress is above its curve" in line for line in damage_remarks(made))


@pytest.mark.parametrize("share", [0.05, 0.1, 0.2, 0.3])
def test_scatter_within_a_row_adds_what_a_normal_torque_does(share):
    count = 20
    torque = np.full(count, 40.0)
    columns = {"input_torque": torque, "input_speed": np.full(count, SPEED)}
    steady = fed(TIME[:count], columns).state().sums
    wide = fed(TIME[:count], columns | {"input_torque_std": share * torque}).state().sums
    p = EXPONENTS
    nodes, weights = np.polynomial.hermite_e.hermegauss(60)
    powers = np.abs(1.0 + share * nodes[:, None]) ** p
    exact = weights @ powers / math.sqrt(2.0 * math.pi)
    factor = wide / steady
    assert factor == pytest.approx(exact, rel=1.2 * (p.max() * share) ** 6 / 720.0 + 1e-9)
    second = 1.0 + 0.5 * p * (p - 1.0) * share**2
    assert np.abs(factor - second).max() < (p.max() * share) ** 4 / 12.0


def test_missing_scatter_within_slow_rows_is_stated_with_its_size():
    time = 10.0 * np.arange(20)
    columns = {"input_torque": np.full(20, 60.0), "input_speed": np.full(20, SPEED)}
    made = fed(time, columns)
    (line,) = (line for line in damage_remarks(made) if "changes within a row" in line)
    worst = int(np.argmax(expected_rates(60.0, SPEED)))
    p = EXPONENTS[worst]
    more = 100.0 * ((1 + 0.1 * 3**0.5) ** p + (1 - 0.1 * 3**0.5) ** p + 4.0) / 6.0 - 100.0
    assert f"adds {float(f'{more:.2g}'):.12g} % to {PARTS[worst]}" in line
    known = fed(time, columns | {"input_torque_std": np.full(20, 1.0)})
    assert not any("changes within a row" in line for line in damage_remarks(known))
    fast = fed(TIME[:20], columns)
    assert not any("changes within a row" in line for line in damage_remarks(fast))


def test_passages_are_whole_numbers_of_the_turns():
    made = fed(TIME, READINGS)
    state, planets = made.state(), SCENE.gearset.planets
    counts = dict(zip(PARTS, state.passages, strict=True))
    teeth = SCENE.gearset.teeth
    kept = np.abs(TORQUE[1:]) <= MOST
    turns = READINGS["input_speed"][1:] * np.diff(TIME) / (2.0 * math.pi)
    forward = (turns * kept * (TORQUE[1:] > 0.0)).sum()
    backward = (turns * kept * (TORQUE[1:] < 0.0)).sum()
    per_turn = teeth.sun  # of a fixed carrier with a driven sun
    assert SCENE.gearset.held == "carrier" and SCENE.drive.input.member == "sun"
    assert counts["sun_flank_drive"] == math.floor(planets * per_turn * forward)
    assert counts["sun_flank_coast"] == math.floor(planets * per_turn * backward)
    assert counts["planet_1_flank_sun"] == math.floor(per_turn * (forward + backward))
    assert counts["planet_1_root"] == math.floor(2 * per_turn * (forward + backward))
    assert counts["planet_1_bearing"] == 0


def test_torques_and_speeds_of_several_senders_belong_together():
    made, whole = counter(), fed(TIME[:200], {n: v[:200] for n, v in READINGS.items()})
    for n in range(200):
        for name in ("oil_temperature", "input_speed", "input_torque"):
            made.add(TIME[n : n + 1], {name: READINGS[name][n : n + 1, None]})
    assert made.state().sums == pytest.approx(whole.state().sums, rel=1e-12)


def test_an_output_speed_is_enough():
    ratio = pt.Follower(pt.load_scene("paper"))._balance.train.ratio
    given = {"input_torque": TORQUE, "output_speed": ratio * READINGS["input_speed"]}
    sums = fed(TIME, given | {"oil_temperature": READINGS["oil_temperature"]}).state().sums
    assert sums == pytest.approx(fed(TIME, READINGS).state().sums, rel=1e-12)


def test_no_speed_is_no_damage_and_no_time():
    state = fed(TIME, {"input_torque": TORQUE}).state()
    assert state.hours == 0.0 and not state.sums.any() and math.isnan(state.remaining_hours[0])


def test_gearboxes_of_a_fleet_are_those_that_are_followed_alone():
    torque = np.stack([TORQUE, TORQUE[::-1], 0.5 * TORQUE], axis=1)
    torque[100:150, 1] = np.nan
    together = counter(count=3, usual=0.1)
    for n in range(400):
        together.add(
            TIME[n : n + 1],
            {"input_torque": torque[n : n + 1], "input_speed": np.full((1, 3), SPEED)},
        )
    for n, state in enumerate(map(together.state, range(3))):
        alone = counter(usual=0.1)
        columns = {"input_torque": torque[:400, n : n + 1], "input_speed": np.full((400, 1), SPEED)}
        alone.add(TIME[:400], columns)
        assert state_text(state, SCENE) == state_text(alone.state(), SCENE)


def test_a_replaced_part_starts_at_zero_and_goes_on():
    made = fed(TIME, READINGS)
    before = made.state().sums
    made.replace_part("planet_2_bearing")
    after = made.state()
    place = PARTS.index("planet_2_bearing")
    assert (
        after.sums[place] == 0.0
        and np.delete(after.sums, place).tolist() == np.delete(before, place).tolist()
    )
    assert after.replaced[0].time == TIME[-1] and after.replaced[0].damage == before[place]
    later = {"input_torque": np.full((11, 1), 60.0), "input_speed": np.full((11, 1), SPEED)}
    made.add(TIME[-1] + 0.1 * np.arange(11), later)
    expected = expected_rates(60.0, SPEED)[place] * 1.0
    assert made.state().sums[place] == pytest.approx(expected, rel=1e-9)


SHAFTS = SCENE.replace(
    durability={
        "shafts": {
            "input": {"range": 40.0, "exponent": 4.0, "reference_cycles": 1e5},
            "output": {"range": 100.0, "exponent": 5.0, "reference_cycles": 1e6},
        }
    }
)
FIGURE_6 = np.array([-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0])


class ShaftMap(PowerMap):
    """A map without vibration."""

    parts = part_names(SHAFTS)

    def rates(self, torque, speed, temperature):
        torque, *_ = np.broadcast_arrays(torque, speed, temperature)
        return np.zeros((*torque.shape, len(self.parts)))


def with_shafts(torque, cuts, **others):
    """Text of the state after readings in parts, each from the text before."""
    text = state_text(DamageState(ShaftMap.parts), SHAFTS)
    columns = {"input_torque": torque, "input_speed": np.full(len(torque), SPEED), **others}
    for a, b in pairwise([0, *cuts, len(torque)]):
        state = parse_state(text, SHAFTS, ShaftMap.parts)
        made = DamageCounter(SHAFTS, ShaftMap(), [state])
        part = {name: values[a:b, None] for name, values in columns.items()}
        made.add(0.1 * np.arange(a, b), part)
        text = state_text(made.state(), SHAFTS)
    return text


@pytest.mark.parametrize("cuts", [[], [4], [1, 2, 3, 4, 5, 6, 7, 8]])
def test_shafts_count_the_closed_cycle_of_the_published_history(cuts):
    text = with_shafts(10.0 * FIGURE_6, cuts, output_torque=-20.0 * FIGURE_6)
    state = parse_state(text, SHAFTS, ShaftMap.parts)
    sums = dict(zip(state.parts, state.sums, strict=True))
    # ASTM E1049-85, figure 6: by the four-point method one cycle of range 4 closes.
    assert sums["input_shaft"] == pytest.approx(1.0 / 1e5, rel=1e-12)
    assert sums["output_shaft"] == pytest.approx(0.8**5 / 1e6, rel=1e-12)
    assert state.turning["input_shaft"] == tuple(10.0 * FIGURE_6[[0, 1, 2, 3, 6, 7, 8]])


@pytest.mark.parametrize("seed", range(3))
def test_cycles_of_shafts_survive_any_restarts_bit_for_bit(seed):
    chance = np.random.default_rng(seed)
    torque = 20.0 * chance.standard_normal(400)
    cuts = np.sort(chance.integers(0, 400, 9))
    whole = with_shafts(torque, [])
    assert with_shafts(torque, cuts) == whole
    assert parse_state(whole, SHAFTS, ShaftMap.parts).sums.max() > 0.0
