"""The unit of a speed is recognised by the positions beside it."""

import math

import numpy as np
import pytest

from planetary_twin_py.following.input_error import InputError
from planetary_twin_py.following.position_check import PositionCheck

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


@pytest.mark.parametrize(("factor", "unit"), [(30 / math.pi, "rpm"), (180 / math.pi, "deg/s")])
@pytest.mark.parametrize("speed", [104.72, -44.88])
def test_another_unit_is_named_with_its_factor(speed, factor, unit):
    with pytest.raises(
        InputError, match=f"if the speed is in {unit}, scale input_speed by {1 / factor:.6g}"
    ):
        read(speed, factor)


def test_readings_with_the_stated_factor_pass():
    read(104.72, 30 / math.pi, scale=math.pi / 30)


@pytest.mark.parametrize(
    ("turning", "said"),
    [
        (0.3, "3.333 times the rate of the positions"),  # of another shaft
        (1.0 / TURN, "6.283 times the rate of the positions of this shaft (2 pi: turns?)"),
        (0.0, "the positions of this shaft do not move: they are not used"),
    ],
)
def test_positions_of_another_rate_are_named_and_speed_is_used(turning, said):
    (line,) = read(104.72, 1.0, turning=turning, wrapped=False)
    assert said in line
