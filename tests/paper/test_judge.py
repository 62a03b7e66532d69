"""Trends are judged at every step, and only where they could be seen."""

import numpy as np
import pytest
from planetary_twin_paper.judge import LEAST_CHANGE, agrees, falls, percent, rises


def test_a_trend_must_hold_at_every_step_and_along_its_axis():
    table = np.array([[1.0, 2.0, 3.0], [1.0, 3.0, 2.5]])
    assert rises(table[0]) and not rises(table[1])
    assert not rises(table) and not rises(table, 0)
    assert falls(-table[0]) and falls(table[0, ::-1]) and not falls(table[0])


def test_a_change_too_small_to_be_seen_is_no_trend():
    assert not rises([1.0, 1.0 + 0.5 * LEAST_CHANGE])
    assert rises([1.0, 1.0 + 2.0 * LEAST_CHANGE])
    assert not falls([1.0, 1.0 - 0.5 * LEAST_CHANGE])
    assert falls([1.0, 1.0 - 2.0 * LEAST_CHANGE])


def test_agreement_is_relative_to_what_is_stated():
    assert agrees([1.009, 100.0], [1.0, 100.0], 0.01)
    assert not agrees([1.02, 100.0], [1.0, 100.0], 0.01)


def test_percent_is_the_largest_change_with_its_sign():
    assert percent([[1.0, 1.1], [1.0, 0.8]]) == pytest.approx(-20.0)
