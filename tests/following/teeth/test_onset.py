"""From which hunting period a tooth has changed."""

import numpy as np
import pytest

from planetary_twin_py.following.teeth.onset import onset_of


def test_a_clear_step_has_one_start():
    amounts = np.concatenate([np.zeros(10), np.full(6, 20.0)])
    assert onset_of(amounts, 1.0) == (10, 10)


def test_a_period_that_changed_in_small_part_is_before_it():
    amounts = np.concatenate([np.zeros(10), [4.0], np.full(6, 20.0)])
    assert onset_of(amounts, 1.0) == (11, 11)


@pytest.mark.parametrize("step", [1.0, 2.0, 4.0])
def test_the_true_start_is_between_both_in_19_of_20_runs(step):
    chance = np.random.default_rng(0)
    held = 0
    for _ in range(1000):
        amounts = chance.standard_normal(40)
        amounts[25:] += step
        first, last = onset_of(amounts, 1.0)
        held += first <= 25 <= last
    assert held >= 950
