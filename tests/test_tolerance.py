"""The tightest tolerance a live twin can afford, chosen from synthetic costs."""

from __future__ import annotations

import itertools
import random
from collections.abc import Callable

import pytest

from planetary_twin_py.tolerance import LADDER, TOLERANCES, AffordableTolerance, ladder_of

PERIOD, SHARE = 0.01, 0.4
STEEPEST = (10.0 / 3.0) ** (1.0 / 3.0)
Load = Callable[[float], float]


def power_law(at_loosest: float, order: float) -> Load:
    """Share of the time that a window costs, as a method of this order makes it."""
    return lambda tolerance: at_loosest * (LADDER[0] / tolerance) ** (1.0 / order)


def chosen(policy: AffordableTolerance, load: Load, seconds: float) -> list[float]:
    """The tolerances of the windows of `seconds`."""
    tolerances = []
    for _ in range(round(seconds / PERIOD)):
        tolerances.append(policy.tolerance)
        policy.observe(PERIOD * load(policy.tolerance))
    return tolerances


def changes(tolerances: list[float]) -> int:
    return sum(a != b for a, b in itertools.pairwise(tolerances))


def automatic() -> AffordableTolerance:
    return AffordableTolerance(LADDER, SHARE, PERIOD)


@pytest.mark.parametrize("order", [3.0, 4.0, 12.0])
@pytest.mark.parametrize("at_loosest", [1e-4, 0.02, 0.07, 0.15, 0.3, 0.9])
def test_it_settles_on_the_tightest_rung_whose_cost_is_granted(order, at_loosest):
    load = power_law(at_loosest, order)
    settled = set(chosen(automatic(), load, 30.0)[-500:])
    assert len(settled) == 1
    (tolerance,) = settled
    assert load(tolerance) <= SHARE or tolerance == LADDER[0]
    assert tolerance == LADDER[-1] or load(LADDER[LADDER.index(tolerance) + 1]) > SHARE


def test_a_machine_that_can_afford_all_gets_there_in_seconds():
    assert chosen(automatic(), lambda _: 0.01, 2.0)[-1] == LADDER[-1]


@pytest.mark.parametrize("load", [1.2, 2.0, 8.0])
def test_two_windows_that_are_too_late_loosen_at_once(load):
    policy = automatic()
    chosen(policy, lambda _: 0.01, 5.0)
    first, second, third = chosen(policy, lambda _: load, 3 * PERIOD)
    assert first == second == LADDER[-1]
    assert third > LADDER[-1]
    # By as many rungs as bring the cost below the share, at the steepest it may fall.
    rungs = LADDER.index(LADDER[-1]) - LADDER.index(third)
    assert load / STEEPEST**rungs <= SHARE or third == LADDER[0]
    assert load / STEEPEST ** (rungs - 1) > SHARE


def test_a_single_late_window_changes_nothing():
    policy = automatic()
    chosen(policy, lambda _: 0.01, 5.0)
    for _ in range(20):
        policy.observe(5.0 * PERIOD)
        assert set(chosen(policy, lambda _: 0.01, 1.0)) == {LADDER[-1]}


def test_a_cost_above_the_share_but_in_time_loosens_within_a_second():
    policy = automatic()
    chosen(policy, lambda _: 0.1, 5.0)
    before = policy.tolerance
    assert chosen(policy, lambda _: 0.6, 1.0)[-1] > before


@pytest.mark.parametrize("seed", range(5))
def test_a_noisy_cost_at_the_limit_does_not_make_it_swing(seed):
    noise = random.Random(seed)
    # The share lies just above the cost of one rung, so that noise asks for both neighbours.
    law = power_law(0.95 * SHARE / STEEPEST**4, 3.0)
    tolerances = chosen(automatic(), lambda t: law(t) * noise.lognormvariate(0.0, 0.3), 600.0)
    assert changes(tolerances) < 40
    assert changes(tolerances[-20_000:]) <= 8  # in the last 200 s


@pytest.mark.parametrize("at_loosest", [0.07, 0.15, 0.3])
def test_a_rung_that_proved_too_dear_is_tried_once(at_loosest):
    tolerances = chosen(automatic(), power_law(at_loosest, 5.0), 300.0)
    loosened = [a < b for a, b in itertools.pairwise(tolerances)]
    assert sum(loosened) == 1


def test_no_rung_is_tried_that_might_be_late():
    policy, load = AffordableTolerance(LADDER, 0.8, PERIOD), power_law(0.7, 3.0)
    tolerances = chosen(policy, load, 60.0)
    assert all(load(tolerance) < 1.0 for tolerance in tolerances[100:])


def test_after_an_overload_it_tightens_again_but_not_soon():
    policy = automatic()
    load = power_law(0.05, 4.0)
    calm = chosen(policy, load, 10.0)[-1]
    chosen(policy, lambda _: 3.0, 0.1)
    loosened = policy.tolerance
    assert loosened > calm
    assert set(chosen(policy, load, 1.0)) == {loosened}
    assert chosen(policy, load, 30.0)[-1] == calm


def test_another_operating_point_is_learnt_anew():
    policy = automatic()
    for _ in range(4):  # each time a tighter rung proves too dear, the next is tried later
        chosen(policy, lambda t: 2.0 if t < LADDER[0] else 0.01, 64.0)
    assert set(chosen(policy, lambda _: 0.01, 5.0)) == {LADDER[0]}
    policy.relearn()
    assert chosen(policy, lambda _: 0.01, 2.0)[-1] == LADDER[-1]


def test_a_storm_of_changes_does_not_hide_an_overload():
    policy = automatic()
    for _ in range(3):
        policy.relearn()
        policy.observe(2.0 * PERIOD)
    assert policy.tolerance == LADDER[0]


def test_windows_shorter_than_a_step_count_by_their_mean():
    policy = automatic()
    for k in range(2000):  # every fourth window pays for the step that spans all four
        policy.observe(PERIOD * (2.4 if k % 4 == 0 else 0.0))
    assert policy.tolerance == LADDER[0]


def test_windows_that_cost_nothing_measurable_are_no_error():
    assert chosen(automatic(), lambda _: 0.0, 2.0)[-1] == LADDER[-1]


def test_a_tolerance_of_the_user_is_kept_whatever_it_costs():
    policy = AffordableTolerance(ladder_of(2e-5), SHARE, PERIOD)
    assert set(chosen(policy, lambda _: 5.0, 5.0)) == {2e-5}
    assert set(chosen(policy, lambda _: 0.0, 5.0)) == {2e-5}


def test_it_begins_with_the_rung_it_is_given():
    for rung in LADDER:
        assert AffordableTolerance(LADDER, SHARE, PERIOD, rung).tolerance == rung
    assert AffordableTolerance(LADDER, SHARE, PERIOD, 2e-5).tolerance == 1e-5


@pytest.mark.parametrize("value", [1e-9, 0.2, -1e-3, float("nan"), float("inf")])
def test_a_tolerance_out_of_range_is_refused_in_one_line(value):
    with pytest.raises(ValueError, match=r"^tolerance = .*1e-08 and 0\.1, or 0 for automatic$"):
        ladder_of(value)
    assert ladder_of(0.0) == LADDER
    assert all(TOLERANCES[0] <= rung <= TOLERANCES[1] for rung in LADDER)
