"""A speed is compared with the positions beside it."""

import math

import numpy as np
import pytest

from planetary_twin_py.following.checks.position_check import PositionCheck

TURN = 2.0 * math.pi


def read(speed, factor, rate=100.0, scale=1.0, wrapped=True, turning=1.0):
    """Let the check read 6 s of a shaft whose speed wanders; readings are `factor` times rad/s."""
    check, time = PositionCheck("input_speed", scale), np.arange(0.0, 6.0, 1.0 / rate)
    wander = 1.0 + 0.05 * np.sin(time)
    angle = turning * speed * (time + 0.05 * (1.0 - np.cos(time)))
    for t, p, v in zip(time, np.mod(angle, TURN) if wrapped else angle, wander, strict=True):
        check.add(t, p, v * speed * factor)
    return list(check.remarks())


@pytest.mark.parametrize("wrapped", [True, False])
@pytest.mark.parametrize("speed", [104.72, -44.88, 3.0, 0.0])
def test_speeds_in_radians_per_second_pass(speed, wrapped):
    assert not read(speed, 1.0, wrapped=wrapped)


def test_readings_with_the_stated_factor_pass():
    read(104.72, 30 / math.pi, scale=math.pi / 30)


@pytest.mark.parametrize(
    ("factor", "turning", "said"),
    [
        (1.0, 0.3, "3.333 times the rate of the positions"),  # of another shaft
        (1.0, 1.0 / TURN, "6.283 times the rate of the positions"),  # in turns
        (30.0 / math.pi, 1.0, "9.549 times the rate of the positions"),  # or a speed in rpm
        (1.0, 0.0, "the positions of this shaft do not move: they are not used"),
    ],
)
def test_a_rate_unlike_the_speed_is_stated_without_a_guess(factor, turning, said):
    (line,) = read(104.72, factor, turning=turning, wrapped=False)
    assert said in line
