"""Size, start and cause of a step of the loss."""

import numpy as np
import pytest

from planetary_twin_py.following.balance_filter import Balance
from planetary_twin_py.following.loss_step import CAUSES, StepCause, size_of

NOISE, STEP, AT = 0.05, 0.04, 150
COURSES = {"friction": 0, "drag": 1, "zero of a torque sensor": 2}


def balances(cause, count=300, seed=0, varied=True):
    """Balances of a train that reverses; a step of one cause from `AT` on."""
    chance = np.random.default_rng(seed)
    found = []
    for n in range(count):
        sign = -1.0 if varied and n % 40 < 20 else 1.0
        friction = sign * (1.0 if not varied or n % 60 < 30 else 0.4)
        course = (friction, sign, 1.0)[COURSES[cause]]
        value = NOISE * chance.standard_normal() + (STEP * course if n >= AT else 0.0)
        slope = np.array([friction, 1.0, sign, 0.0, 0.0, 0.0, 0.0])
        found.append(Balance(value, NOISE, slope, friction, sign))
    return found


def test_the_size_and_the_start_hold_the_truth_in_19_of_20_runs():
    known = np.zeros((7, 7))
    found = [size_of(balances("drag", 200, seed, varied=False), known) for seed in range(400)]
    inside = np.mean([abs(one.size - STEP) < 1.96 * one.sd for one in found])
    assert 0.91 < inside < 0.985
    assert np.mean([one.size for one in found]) == pytest.approx(STEP, rel=0.05)
    assert np.mean([one.first <= AT for one in found]) > 0.95


def test_a_step_of_either_sign_has_the_same_size():
    rows = balances("drag", varied=False)
    one, other = (
        size_of([row._replace(value=sign * row.value) for row in rows], np.zeros((7, 7)))
        for sign in (1.0, -1.0)
    )
    assert (one.size, one.sd) == (-other.size, other.sd)


def test_errors_of_the_parameters_widen_the_interval():
    covariance = np.diag([0.0, 0.03**2, 0.0, 0.0, 0.0, 0.0, 0.0])
    rows = balances("drag", varied=False)
    sharp, wide = (size_of(rows, one).sd for one in (np.zeros((7, 7)), covariance))
    assert wide == pytest.approx(np.hypot(sharp, 0.03))


@pytest.mark.parametrize("cause", CAUSES)
def test_reversals_and_loads_show_the_cause(cause):
    found = StepCause(0.0, 1e-10 * np.eye(7))
    for row in balances(cause, 1500)[AT:]:
        found.add(row)
    assert found.causes == (cause,)


@pytest.mark.parametrize("cause", CAUSES)
def test_no_cause_is_excluded_where_the_parameters_explain_it(cause):
    found = StepCause(0.0, np.eye(7))
    for row in balances(cause, 1500)[AT:]:
        found.add(row)
    assert set(found.causes) == set(CAUSES)
