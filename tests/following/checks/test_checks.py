"""Wrong units, signs and shafts are named by what the readings and the scene state."""

import re

import numpy as np
import pytest
from following.plants import paper, played
from tiers import first

from planetary_twin_py.following.follower import Follower
from planetary_twin_py.following.input_error import InputError
from planetary_twin_py.following.readings import Readings
from planetary_twin_py.following.sensors import Sensors

RPM = 30.0 / np.pi
SPEEDS, TORQUES = r"output_speed/input_speed = ", r"output_torque/input_torque = "
WRONG = {
    "speed of the output in rpm": ({"output_speed": RPM}, SPEEDS + r"-4\.09.: must be -0\.4286"),
    "both in rpm": (
        {"input_speed": RPM * 2, "output_speed": RPM * 2},
        r"readings: exceeds 1\.2 times drive\.speed_limit.*is it in rad/s\?",
    ),
    "reversed speed": ({"output_speed": -1.0}, SPEEDS + r"0\.428.: must be -0\.4286"),
    "reversed torque": ({"output_torque": -1.0}, TORQUES + r"-2\.3"),
    "both torques reversed": (
        {"input_torque": -1.0, "output_torque": -1.0}, "loss torque = -.*must be positive",
    ),
    "torque in N mm": ({"output_torque": 1e3}, r"output_torque = .*exceeds 2 times"),
    "input torque in lbf ft": ({"input_torque": 0.73756}, "loss torque = -.*must be positive"),
    "output torque in kgf m": ({"output_torque": 0.10197}, TORQUES),
    "degrees Celsius": ({"oil_temperature": 70.0 / 343.15}, r"is headed oil_temperature \[degC\]"),
    "exchanged shafts": ({"input_speed": -3 / 7, "output_speed": -7 / 3}, SPEEDS + r"-2\.333"),
}  # fmt: skip


@pytest.fixture(scope="module")
def readings():
    return played("varied", {}, 8.0)[1:]


@pytest.mark.parametrize("what", WRONG)
def test_it_is_refused_in_one_line(readings, what):
    factors, said = WRONG[what]
    time, columns = readings
    wrong = {name: values * factors.get(name, 1.0) for name, values in columns.items()}
    with pytest.raises(InputError, match=said) as error:
        Follower(paper()).add(Readings(time, wrong))
    assert "\n" not in str(error.value)


def test_recording_shorter_than_the_check_is_checked_at_its_end(readings):
    time, columns = readings
    short = {name: values[:300] for name, values in columns.items()}
    follower = Follower(paper())
    follower.add(Readings(time[:300], short | {"output_speed": -short["output_speed"]}))
    with pytest.raises(InputError, match="output_speed/input_speed"):
        follower.finish()


def from_second(second, time, columns, factors):
    """Columns that are wrong by factors from a time on."""
    late = time > second
    return {
        name: np.where(late, values * factors.get(name, 1.0), values)
        for name, values in columns.items()
    }


def become_wrong(what):
    """Remarks on readings that are wrong from 12 s on."""
    time, columns = played("steady", {}, 30.0)[1:]
    follower = Follower(paper())
    follower.add(Readings(time, from_second(12.0, time, columns, WRONG[what][0])))
    follower.finish()
    assert not follower.estimate().events
    return follower.estimate().remarks


def test_speeds_that_become_wrong_are_a_remark_with_the_time():
    what = "speed of the output in rpm"
    (line,) = (line for line in become_wrong(what) if re.search(WRONG[what][1], line))
    assert line.startswith("readings after 10.0 s contradict the scene")


def test_a_torque_that_becomes_wrong_is_left_out_with_its_time():
    (line,) = become_wrong("reversed torque")
    assert line.startswith("output_torque: left out, because both torques show a loss that no")
    assert "from 12.00 to 30.10 s (1800 readings)" in line


def test_an_impossible_temperature_is_a_remark_and_not_used():
    time, columns = played("steady", {}, 20.0)[1:]
    wrong = np.where(time > 12.0, 70.0, 343.15)
    follower = Follower(paper())
    follower.add(Readings(time, columns | {"oil_temperature": wrong}))
    follower.finish()
    found = follower.estimate()
    assert any("(messages are in degrees Celsius): 70 K from 12.01" in one for one in found.remarks)
    assert found.operating[1] == pytest.approx(343.15)


@pytest.mark.parametrize("duty", first(1, ["varied", "steady", "reversing"]))
def test_good_readings_cause_no_remark_in_two_minutes(duty):
    _, time, columns = played(duty, {}, 120.0, 3)
    follower = Follower(paper())
    follower.add(Readings(time, columns))
    follower.finish()
    assert not any("contradict" in line for line in follower.estimate().remarks)


def test_a_run_up_that_takes_all_torque_is_no_contradiction():
    """All torque goes to the inertia: T = J a in closed form, with a loss of 0.3 N m."""
    inertia, time = 5.0, np.arange(1, 1401) / 100.0
    speed = np.minimum(10.5 * time, 104.7)
    accelerating = speed < 104.7
    columns = {
        "input_torque": np.where(accelerating, inertia * 10.5 + 0.3, 63.0),
        "output_torque": np.where(accelerating, 0.0, 62.0 * 7.0 / 3.0),
        "input_speed": speed,
    }
    follower = Follower(paper(), Sensors(inertia=inertia))
    follower.add(Readings(time, columns))
    follower.finish()


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
