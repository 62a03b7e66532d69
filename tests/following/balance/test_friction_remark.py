"""A friction level that the readings hardly determine is named, with what has the same effect."""

import re

import numpy as np
import pytest
from following.plants import balance_of, paper, played

from planetary_twin_py.following.balance.follower import BalanceFollower
from planetary_twin_py.following.balance.friction_remark import friction_remarks


@pytest.mark.parametrize(
    ("interval", "said"),
    [
        ((-0.14, 0.16, 0.45), "values below 0 are impossible"),
        ((0.2, 0.45, 0.7), "an interval of 0.2 to 0.7: the readings hardly determine it"),
        ((-0.5, -0.3, -0.1), "friction_level is below -0.1, which is impossible"),
        ((0.7, 1.0, 1.3), None),
        ((np.nan, np.nan, np.nan), None),
    ],
)
def test_impossible_and_wide_intervals_are_named(interval, said):
    lines = list(friction_remarks(*interval, 0.97))
    assert len(lines) == (said is not None)
    assert not lines or said in lines[0]


@pytest.mark.parametrize("zero", [-0.8, -0.7])
def test_the_stated_zero_is_that_of_the_sensor(zero):
    """All friction but that of the scene is explained by the zero of the input torque."""
    _, time, columns = played(
        "steady", {}, 40.0, 0, sensors={
            "input_torque": {"noise": 0.1, "zero": zero}, "output_torque": {"noise": 0.25},
        },
    )  # fmt: skip
    follower = BalanceFollower(paper())
    follower.add(time, columns)
    (line,) = (line for line in follower.remarks() if line.startswith("friction_level"))
    stated = float(re.search(r"of ([+-][\d.]+) N m at the input", line)[1])
    assert stated == pytest.approx(zero, abs=0.25)


def test_a_friction_level_that_is_determined_has_no_remark():
    for kind in ("steady", "reversing"):
        _, follower = balance_of(kind, {}, 60.0, 2)
        assert not any(line.startswith("friction_level") for line in follower.remarks())
