"""Damage of a run: sums of its windows, and the messages that are due."""

import numpy as np
import pytest
from following.power_map import PARTS, SCENE

from planetary_twin_py.durability.damage import Damage
from planetary_twin_py.durability.damage_state import DamageState
from planetary_twin_py.durability.run_damage import RunDamage
from planetary_twin_py.durability.state_text import state_text
from planetary_twin_py.recording.runs.origin import Makers, Origin, damage_at, read_origin

TEETH = np.array([1 if part.endswith("bearing") else 5 for part in PARTS])
INTERVAL = 0.01


def window(n):
    """Damage of a window, and its passages."""
    chance = np.random.default_rng(n)
    sums = chance.random(len(PARTS)) * 1e-9
    return Damage(INTERVAL, PARTS, sums, chance.integers(0, 9, len(PARTS)), TEETH)


def run_of(start, first, last):
    run, due = RunDamage(start), []
    for n in range(first, last):
        run.add(window(n))
        due.append(run.messages(n * INTERVAL, (n + 1) * INTERVAL))
    return run, due


def test_a_run_continued_in_parts_has_the_same_bits():
    whole, _ = run_of(DamageState(PARTS), 0, 500)
    first, _ = run_of(DamageState(PARTS), 0, 123)
    second, _ = run_of(first.state, 123, 500)
    assert state_text(second.state, SCENE) == state_text(whole.state, SCENE)
    assert whole.state.hours * 3600.0 == pytest.approx(5.0, rel=1e-12)
    passages = np.sum([window(n).passages for n in range(500)], axis=0)
    assert whole.state.passages == passages.tolist()


def test_state_is_due_each_second_and_teeth_each_ten():
    _, due = run_of(DamageState(PARTS), 0, 2100)
    of_state = [n for n, each in enumerate(due) if "damage_state" in each]
    of_teeth = [n for n, each in enumerate(due) if "damage_teeth" in each]
    assert of_state == [100 * n - 1 for n in range(1, 22)]
    assert of_teeth == [999, 1999]


def test_rate_is_that_of_the_time_since_the_last_message():
    _, due = run_of(DamageState(PARTS), 0, 200)
    message = due[199]["damage_state"]
    expected = np.sum([window(n).damage for n in range(100, 200)], axis=0) * 3600.0
    assert message["rate"] == pytest.approx(expected, rel=1e-9)
    mean = np.sum([window(n).damage for n in range(200)], axis=0) * 1800.0
    assert message["mean_rate"] == pytest.approx(mean, rel=1e-9)
    assert message["remaining_hours"] == pytest.approx((1.0 - message["damage"]) / mean)


def test_a_part_that_is_replaced_starts_at_zero_in_the_next_message():
    run, _ = run_of(DamageState(PARTS), 0, 150)
    before = run.state.sums
    run.replace_part("sun", 1.5)
    for n in range(150, 200):
        run.add(window(n))
    message = run.messages(1.99, 2.0)["damage_state"]
    later = np.sum([window(n).damage for n in range(150, 200)], axis=0)
    for n, part in enumerate(PARTS):
        kept = 0.0 if part.startswith("sun_") else before[n]
        assert message["damage"][n] == pytest.approx(kept + later[n], rel=1e-12)
        assert message["rate"][n] >= 0.0
    assert message["replaced"] == [part for part in PARTS if part.startswith("sun_")]
    assert message["replaced_at"].tolist() == [1.5] * 3


def test_teeth_of_a_part_have_its_mean():
    run, due = run_of(DamageState(PARTS), 0, 1000)
    message = due[-1]["damage_teeth"]
    gears = [part for part in PARTS if not part.endswith("bearing")]
    assert message["parts"] == gears and message["teeth"].tolist() == [5] * len(gears)
    assert message["damage"].reshape(-1, 5).mean(axis=1) == pytest.approx(
        run.state.sums[: len(gears)]
    )


def test_the_origin_of_a_run_has_its_damage_with_all_bits():
    state = run_of(DamageState(PARTS), 0, 77)[0].state
    makers = Makers("kernels", "machine", {})
    again = read_origin(Origin(SCENE, 5, makers, state).text())
    assert state_text(damage_at(again).state, SCENE) == state_text(state, SCENE)
    assert not damage_at(read_origin(Origin(SCENE, 5, makers).text())).state.sums.any()
    assert damage_at(Origin(SCENE.replace(durability=None), 5, makers)) is None
