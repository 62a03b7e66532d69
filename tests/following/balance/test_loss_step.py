"""Size, start and cause of a step of the loss."""

import numpy as np
import pytest

from planetary_twin_py.following.balance.balances import Balances
from planetary_twin_py.following.balance.loss_step import CAUSES, StepCause, size_of

NOISE, STEP, AT = 0.05, 0.04, 150


def balances(cause, count=300, seed=0, varied=True):
    """Balances of a train that reverses; a step of one cause from `AT` on."""
    n, one = np.arange(count), np.ones(count)
    sign = np.where(varied & (n % 40 < 20), -one, one)
    friction = sign * np.where(varied & (n % 60 >= 30), 0.4, 1.0)
    torque = np.where(varied & (n % 100 < 50), -one, one)
    added = np.array([friction, sign, one, torque])[CAUSES.index(cause)]
    value = NOISE * np.random.default_rng(seed).standard_normal(count)
    slope = np.column_stack([friction, one, sign, torque, *np.zeros((3, count))])
    return Balances(
        value + STEP * added * (n >= AT), NOISE * one, slope, friction, torque, one, one
    )


def test_the_size_and_the_start_hold_the_truth_in_19_of_20_runs():
    known = np.zeros((7, 7))
    found = [size_of(balances("drag", 200, seed, varied=False), known) for seed in range(400)]
    inside = np.mean([abs(one.size - STEP) < 1.96 * one.sd for one in found])
    assert 0.91 < inside < 0.985
    assert np.mean([one.size for one in found]) == pytest.approx(STEP, rel=0.05)
    assert np.mean([one.first <= AT for one in found]) > 0.95


def test_balances_before_step_limit_the_error_of_the_parameters():
    covariance = np.diag([0.0, 0.03**2, 0.0, 0.0, 0.0, 0.0, 0.0])
    rows = balances("drag", varied=False)
    sharp, wide = (size_of(rows, one).sd for one in (np.zeros((7, 7)), covariance))
    before = (0.03**-2 + AT / NOISE**2) ** -0.5  # of a mean whose prior is 0 +- 0.03
    assert wide == pytest.approx(np.hypot(sharp, before), rel=0.03)


def test_start_of_change_of_friction_is_sought_where_friction_is():
    """A step at low torque hardly shows: its start is stated no later than where it happened."""
    found = [size_of(balances("friction", 200, seed), np.zeros((7, 7))) for seed in range(200)]
    assert np.mean([one.first <= AT for one in found]) > 0.95


@pytest.mark.parametrize("cause", CAUSES)
def test_reversals_and_loads_show_the_cause(cause):
    found = StepCause(0.0, 1e-10 * np.eye(7))
    found.add(balances(cause, 1500).since(AT))
    assert found.causes == (cause,)


def test_an_impossible_cause_is_never_named():
    found = StepCause(0.0, 1e-10 * np.eye(7), CAUSES[1:])
    assert found.causes == CAUSES[1:]
    found.add(balances(CAUSES[0], 1500).since(AT))
    assert found.causes and CAUSES[0] not in found.causes
