"""Torque sensors that measure nothing are named, with the time since when."""

import numpy as np
import pytest
from following.plants import paper, played

from planetary_twin_py.following.follower import Follower, Readings
from planetary_twin_py.following.input_error import InputError

BOTH = "input_torque", "output_torque"


def remarks(dead, since=0.0, until=20.0, speed=1.0):
    """Lines on dead torques after 20 s in which channels are 0 for some time."""
    _, time, columns = played("steady", {}, 20.0)
    zero = (time > since) & (time <= until)
    read = {name: np.where(zero & (name in dead), 0.0, values) for name, values in columns.items()}
    for name in ("input_speed", "output_speed"):
        read[name] = np.where(zero, speed * read[name], read[name])
    follower = Follower(paper())
    follower.add(Readings(time, read))
    follower.finish()
    return [line for line in follower.estimate().remarks if "exactly 0" in line]


def test_torques_that_are_zero_in_all_rows_are_named():
    assert [line.split(" since")[0] for line in remarks(BOTH)] == [
        f"{n} is exactly 0" for n in BOTH
    ]


@pytest.mark.parametrize("name", BOTH)
def test_a_torque_that_becomes_zero_is_named_with_the_time(name):
    lines = remarks((name,), 10.0)
    assert any(line.startswith(f"{name} is exactly 0 since 10.0 s") for line in lines)


def test_a_machine_that_stands_without_torque_has_no_dead_sensor():
    assert remarks(BOTH, 10.0, speed=0.0) == []


@pytest.mark.parametrize("name", BOTH)
def test_a_torque_that_is_zero_under_load_is_refused(name):
    with pytest.raises(InputError, match=f"^{name} is exactly 0 and .* sensor of {name} connected"):
        remarks((name,))
