"""Wrong units, signs and shafts are named with their remedy."""

import numpy as np
import pytest
from following.plants import paper, played

from planetary_twin_py.following.checks import InputError
from planetary_twin_py.following.follower import Follower, Readings

RPM = 30.0 / np.pi
WRONG = {
    "speed of the output in rpm": ({"output_speed": RPM}, "scale output_speed by 0.10472"),
    "speed of the input in rpm": ({"input_speed": RPM}, "scale input_speed by 0.10472"),
    "both in rpm": ({"input_speed": RPM * 2, "output_speed": RPM * 2}, "scale input_speed by 0.10"),
    "reversed speed": ({"output_speed": -1.0}, "scale output_speed by -1"),
    "reversed torque": ({"output_torque": -1.0}, "scale output_torque by -1"),
    "both torques reversed": (
        {"input_torque": -1.0, "output_torque": -1.0}, "scale input_torque and output_torque by -1",
    ),
    "both speeds reversed": (
        {"input_speed": -1.0, "output_speed": -1.0}, "signs of both torques or of both speeds",
    ),
    "torque in N mm": ({"output_torque": 1e3}, "output_torque is probably in N mm"),
    "torque in kN m": ({"input_torque": 1e-3}, "input_torque is probably in kN m"),
    "both torques in N mm": (
        {"input_torque": 1e3, "output_torque": 1e3}, "if torques are in N mm, scale input_torque",
    ),
    "degrees Celsius": ({"oil_temperature": 70.0 / 343.15}, "probably degC"),
    "exchanged shafts": (
        {"input_speed": -3 / 7, "output_speed": -7 / 3}, "input and output are exchanged",
    ),
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


@pytest.mark.parametrize("what", ["reversed torque", "speed of the output in rpm"])
def test_the_stated_correction_is_accepted(readings, what):
    factors, said = WRONG[what]
    time, columns = readings
    wrong = {name: values * factors.get(name, 1.0) for name, values in columns.items()}
    name, factor = said.removeprefix("scale ").split(" by ")
    mended = Follower(paper(), scale={name: float(factor)})
    mended.add(Readings(time, wrong))
    assert mended.estimate()["input_torque"].status == "ESTIMATED"


@pytest.mark.parametrize("duty", ["steady", "reversing"])
@pytest.mark.parametrize("seed", range(3))
def test_a_loss_within_the_errors_of_the_sensors_is_accepted(duty, seed):
    _, time, columns = played(duty, {}, 8.0, seed)
    Follower(paper()).add(Readings(time, columns))


def test_a_coasting_train_is_no_reversed_one():
    speed = np.linspace(104.7, 60.0, 700)  # the motor brakes and the load gives its inertia
    follower = Follower(paper())
    torque = 0.4 + follower._balance.train.inertia * np.gradient(speed, 0.01)
    columns = {
        "input_torque": torque,
        "output_torque": np.zeros(len(speed)),
        "input_speed": speed,
    }
    follower.add(Readings(np.arange(1, 701) / 100.0, columns))


def test_a_recording_shorter_than_the_check_is_checked_at_its_end(readings):
    time, columns = readings
    short = {name: values[:300] for name, values in columns.items()}
    follower = Follower(paper())
    follower.add(Readings(time[:300], short | {"output_speed": -short["output_speed"]}))
    with pytest.raises(InputError, match="scale output_speed by -1"):
        follower.finish()


def test_good_readings_pass(readings):
    follower = Follower(paper())
    follower.add(Readings(*readings))
    follower.finish()
    counters = follower.estimate().counters
    assert counters["used"] + counters["outlying"] == 5 * 800


def test_kelvin_taken_for_degrees_celsius_is_named(readings):
    time, columns = readings
    warm = np.full(len(time), 343.15 + 273.15)
    with pytest.raises(InputError, match="this sender probably uses kelvin"):
        Follower(paper()).add(Readings(time, columns | {"oil_temperature": warm}))
