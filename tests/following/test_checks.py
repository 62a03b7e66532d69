"""Wrong units, signs and shafts are named with their remedy."""

import numpy as np
import pytest
from following.plants import paper, played
from tiers import first

from planetary_twin_py.following.checks import InputError
from planetary_twin_py.following.contradictions import Contradictions, Rows
from planetary_twin_py.following.follower import Follower, Readings
from planetary_twin_py.following.sensors import Sensors
from planetary_twin_py.following.train import followed_train

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
    "output torque in lbf in": (
        {"output_torque": 8.8507}, "in lbf in: scale output_torque by 0.11298",
    ),
    "input torque in lbf in": (
        {"input_torque": 8.8507}, "in lbf in: scale input_torque by 0.11298",
    ),
    "input torque in lbf ft": (
        {"input_torque": 0.73756}, "in lbf ft: scale input_torque by 1.3558",
    ),
    "output torque in kgf m": (
        {"output_torque": 0.10197}, "in kgf m: scale output_torque by 9.8066",
    ),
    "input torque in kgf cm": (
        {"input_torque": 10.197}, "in kgf cm: scale input_torque by 0.09806",
    ),
    "both torques in N mm": (
        {"input_torque": 1e3, "output_torque": 1e3}, "if torques are in N mm, scale input_torque",
    ),
    "degrees Celsius": ({"oil_temperature": 70.0 / 343.15}, "probably degC"),
    "exchanged shafts": (
        {"input_speed": -3 / 7, "output_speed": -7 / 3}, "input and output are exchanged",
    ),
    "exchanged torques": (
        {"input_torque": 7 / 3, "output_torque": 3 / 7},
        "input_torque and output_torque seem to be exchanged",
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


def test_a_unit_that_leaves_a_plausible_ratio_is_asked_for(readings):
    time, columns = readings
    follower = Follower(paper())
    follower.add(Readings(time, columns | {"output_torque": 0.73756 * columns["output_torque"]}))
    (line,) = (one for one in follower.estimate().remarks if "lbf" in one)
    assert "output_torque is probably in lbf ft: scale output_torque by 1.3558" in line


def test_a_lossy_scene_is_not_taken_for_a_wrong_unit(readings):
    time, columns = readings
    drag = 0.27 * float(np.median(columns["input_torque"]))
    scene = paper().replace(**{"losses.sun_drag.coulomb": drag})
    lost = drag * np.sign(columns["input_speed"]) / followed_train(scene).ratio
    lossy = columns | {"output_torque": columns["output_torque"] + lost}
    assert 0.66 < np.median(lossy["output_torque"] / columns["output_torque"]) < 0.75
    follower = Follower(scene)
    follower.add(Readings(time, lossy))
    assert not [line for line in follower.estimate().remarks if "lbf" in line]


@pytest.mark.parametrize("what", ["reversed torque", "speed of the output in rpm"])
def test_the_stated_correction_is_accepted(readings, what):
    factors, said = WRONG[what]
    time, columns = readings
    wrong = {name: values * factors.get(name, 1.0) for name, values in columns.items()}
    name, factor = said.removeprefix("scale ").split(" by ")
    mended = Follower(paper(), scale={name: float(factor)})
    mended.add(Readings(time, wrong))
    assert mended.estimate()["input_torque"].status == "ESTIMATED"


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_torques_of_the_same_shaft_are_not_called_exchanged(sign):
    train = followed_train(paper())._replace(ratio=-0.2)
    torque = np.full(10, train.torque)
    speed = np.full(10, train.speed)
    rows = Rows(
        np.arange(1.0, 11.0),
        {"input_speed": speed, "output_speed": -0.2 * speed, "input_torque": torque}
        | {"output_torque": 0.99 * sign * torque},
    )
    found = Contradictions(train, Sensors(), 1.0).shown_by(rows)
    assert found["torques"].endswith("both torques seem to be referred to the same shaft")


@pytest.mark.parametrize("duty", ["steady", "reversing"])
@pytest.mark.parametrize("seed", range(3))
def test_a_loss_within_the_errors_of_the_sensors_is_accepted(duty, seed):
    _, time, columns = played(duty, {}, 8.0, seed)
    Follower(paper()).add(Readings(time, columns))


def test_a_run_up_that_begins_in_the_last_row_contradicts_nothing():
    time = np.arange(1, 3006) / 100.0
    follower, torque = Follower(paper()), np.where(time > 30.0, 63.0, 0.0)
    speed = torque / follower._balance.train.inertia * np.maximum(time - 30.0, 0.0)
    columns = {"input_torque": torque, "output_torque": np.zeros(len(time)), "input_speed": speed}
    follower.add(Readings(time, columns))
    follower.finish()
    assert not [line for line in follower.estimate().remarks if "contradict" in line]


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


def from_second(second, time, columns, factors):
    """Columns that are wrong by factors from a time on."""
    late = time > second
    return {
        name: np.where(late, values * factors.get(name, 1.0), values)
        for name, values in columns.items()
    }


def at_rest_first(readings, seconds):
    """Readings after a standstill without load."""
    time, columns = readings
    rest = np.arange(1, 100 * seconds + 1) / 100.0
    before = {
        name: np.full(len(rest), 343.15 if name == "oil_temperature" else 0.0) for name in columns
    }
    return np.concatenate([rest, seconds + time]), {
        name: np.concatenate([before[name], values]) for name, values in columns.items()
    }


LATE = [what for what in WRONG if what != "degrees Celsius"]


@pytest.mark.parametrize("what", first(3, LATE))
def test_it_is_refused_too_if_the_train_turns_only_after_a_minute(readings, what):
    factors, said = WRONG[what]
    time, columns = at_rest_first(readings, 60)
    wrong = {name: values * factors.get(name, 1.0) for name, values in columns.items()}
    follower = Follower(paper())
    with pytest.raises(InputError, match=said):
        follower.add(Readings(time, wrong))
        follower.finish()


@pytest.mark.parametrize("what", ["reversed torque", "speed of the output in rpm"])
def test_readings_that_become_wrong_during_the_run_are_a_remark_with_their_time(what):
    factors, said = WRONG[what]
    time, columns = played("steady", {}, 30.0)[1:]
    follower = Follower(paper())
    follower.add(Readings(time, from_second(12.0, time, columns, factors)))
    follower.finish()
    (line,) = (line for line in follower.estimate().remarks if said in line)
    assert line.startswith("readings after 10.0 s contradict the scene")


def test_a_temperature_that_becomes_impossible_is_a_remark_and_not_used():
    time, columns = played("steady", {}, 20.0)[1:]
    wrong = np.where(time > 12.0, 70.0, 343.15)
    follower = Follower(paper())
    follower.add(Readings(time, columns | {"oil_temperature": wrong}))
    follower.finish()
    found = follower.estimate()
    assert any("after 12.0 s" in line and "probably degC" in line for line in found.remarks)
    assert found.operating[1] == pytest.approx(343.15)


@pytest.mark.parametrize("duty", first(1, ["varied", "steady", "reversing"]))
def test_good_readings_cause_no_remark_in_two_minutes(duty):
    _, time, columns = played(duty, {}, 120.0, 3)
    follower = Follower(paper())
    follower.add(Readings(time, columns))
    follower.finish()
    assert not any("contradict" in line for line in follower.estimate().remarks)


def test_a_run_up_whose_torque_accelerates_the_train_is_no_contradiction():
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
