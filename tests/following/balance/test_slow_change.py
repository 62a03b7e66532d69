"""A friction level that drifts without a step is named."""

import pytest
from following.plants import balance_of

from planetary_twin_py.following.balance.slow_change import SETTLED, SlowChange


def drifted(*levels):
    """Remarks after an uncertain start and levels, each with its standard deviation."""
    change = SlowChange()
    change.add(10.0, 0.7, 0.1)
    for n, (value, sd) in enumerate(levels):
        change.add(10.0 + SETTLED * (n + 1), value, sd)
    return list(change.remarks())


def test_a_level_is_compared_with_the_first_that_has_settled():
    (line,) = drifted((1.0, 0.02), (1.05, 0.02), (1.1, 0.02))
    assert line.startswith(
        "friction_level has drifted from 1 +- 0.039 at 130 s to 1.1 +- 0.039 at 370 s"
    )


@pytest.mark.parametrize("levels", [[], [(1.0, 0.02)], [(1.0, 0.02), (1.07, 0.02)]])
def test_without_a_settled_start_nothing_is_named(levels):
    assert drifted(*levels) == []


@pytest.mark.exhaustive
def test_a_slow_drift_by_ten_percent_is_named_and_is_no_step():
    slow = tuple({"at": 180.0 + 40.0 * n, "friction": 1.0 + 0.0025 * n} for n in range(1, 41))
    _, follower = balance_of("reversing", {}, 1800.0, 3, slow)
    assert follower.events == []
    (line,) = (line for line in follower.remarks() if "drifted" in line)
    assert line.startswith("friction_level has drifted from ")


def test_after_step_level_is_compared_with_that_after_the_step():
    _, follower = balance_of("reversing", {}, 300.0, 1, ({"at": 150.0, "friction": 1.2},))
    assert len(follower.events) == 1
    assert not any("drifted" in line for line in follower.remarks())
