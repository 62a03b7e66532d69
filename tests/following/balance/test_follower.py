"""Friction, drag, zero, gain and inertia of plants whose true values are known."""

import numpy as np
import pytest
from following.plants import LAWS, balance_of, friction_level, paper, played
from tiers import first

from planetary_twin_py.following.balance.balances import CAUSES
from planetary_twin_py.following.balance.follower import BalanceFollower

RPM = 30.0 / np.pi
DELAYS = {"steady": 10.0, "varied": 15.0, "reversing": 15.0}  # [s] until +5 % friction is found


def named(follower):
    return {one.name: one for one in follower.estimates()}


@pytest.mark.parametrize("kind", first(1, DELAYS))
def test_a_step_of_friction_by_five_percent_is_found(kind):
    _, follower = balance_of(
        kind, LAWS["with bearings"], 90.0, 3, ({"at": 60.0, "friction": 1.05},)
    )
    (event,) = follower.events
    assert event.what == "loss torque stepped"
    assert event.since <= 62.0 and 60.0 < event.found <= 60.0 + DELAYS[kind]
    assert event.size.value > 0.0 and "friction" in event.causes


def test_a_reversal_separates_friction_from_drag_and_zero():
    changes = ({"at": 40.0, "friction": 1.2},)
    _, follower = balance_of("reversing", {}, 90.0, 1, changes)
    assert follower.events[0].causes == ("friction",)


def test_steady_running_does_not_show_the_cause_of_a_step():
    _, follower = balance_of("steady", {}, 90.0, 1, ({"at": 40.0, "torque_zero": 0.1},))
    assert set(follower.events[0].causes) == set(CAUSES)


@pytest.mark.parametrize("law", first(1, reversed(LAWS)))
def test_a_reversing_duty_determines_friction_to_some_percent(law):
    plant, follower = balance_of("reversing", LAWS[law], 60.0, 5)
    friction = named(follower)["friction_level"]
    assert friction.status == "ESTIMATED" and friction.sd < 0.04
    assert friction.low < friction_level(plant) < friction.high


def test_steady_running_does_not_determine_drag_or_gain():
    _, follower = balance_of("steady", {}, 60.0, 5)
    found = named(follower)
    for name in ("drag", "torque_zero", "torque_gain", "inertia"):
        assert found[name].status == "NOT_IDENTIFIABLE" and np.isnan(found[name].value)
        assert found[name].remedy.startswith("a ")
    assert "reversal" in found["drag"].remedy and "speed" in found["inertia"].remedy


def test_a_changing_speed_determines_the_inertia():
    _, follower = balance_of("varied", {}, 60.0, 5)
    inertia = named(follower)["inertia"]
    assert inertia.status == "ESTIMATED" and inertia.sd < 0.03 * follower.train.inertia
    assert inertia.low < follower.train.inertia < inertia.high


def test_accelerations_within_a_bin_do_not_bias_the_inertia():
    errors = []
    for seed in range(24):
        _, follower = balance_of("varied", {}, 60.0, seed)
        errors.append(named(follower)["inertia"].value / follower.train.inertia - 1.0)
    assert abs(np.mean(errors)) < 5e-3  # of one run: 1e-2


def test_the_loss_torque_is_that_of_the_plant():
    plant, follower = balance_of("steady", LAWS["another friction"], 30.0, 2)
    loss = named(follower)["loss_torque"]
    true = friction_level(plant) * 0.967  # [N m], of scene `paper` with load_sharing, 63 N m
    assert loss.low < true < loss.high and loss.sd < 0.2


WRONG = {  # sensors far out of their stated accuracy, and a true cause
    "gain +10 %": ({"input_torque": {"noise": 0.1, "gain": 0.1}}, "gain of a torque sensor"),
    "zero +2 N m": ({"input_torque": {"noise": 0.1, "zero": 2.0}}, "zero of a torque sensor"),
}  # fmt: skip


@pytest.mark.parametrize("kind", first(1, DELAYS))
@pytest.mark.parametrize("wrong", WRONG)
def test_a_sensor_wrong_from_the_start_is_one_finding(kind, wrong):
    sensors, cause = WRONG[wrong]
    plant, time, columns = played(kind, {}, 60.0, 1, sensors=sensors)
    follower = BalanceFollower(paper())
    follower.add(time, columns)
    (event,) = follower.events
    assert event.what == "readings do not fit the scene" and cause in event.causes
    assert event.since < 0.5 and event.found < 2.0
    friction = named(follower)["friction_level"]
    if kind == "reversing":
        assert friction.low < friction_level(plant) < friction.high
    else:  # nothing tells friction from a gain while the torque keeps its sign
        assert friction.status == "NOT_IDENTIFIABLE"


@pytest.mark.parametrize("kind", first(1, DELAYS))
def test_a_gain_that_changes_during_the_run_is_one_event(kind):
    _, time, columns = played(kind, {}, 90.0, 4)
    columns["input_torque"] = np.where(time > 30.0, 1.1, 1.0) * columns["input_torque"]
    follower = BalanceFollower(paper())
    follower.add(time, columns)
    (event,) = follower.events
    assert event.what == "loss torque stepped" and 28.0 < event.since <= 30.0 < event.found < 32.0
    assert "gain of a torque sensor" in event.causes


def test_repeated_steps_give_three_events_at_most():
    _, time, columns = played("steady", {}, 100.0, 4)
    gain = 1.0 + 0.04 * np.sign(np.sin(2.0 * np.pi * (time - 30.0) / 30.0)) * (time > 30.0)
    columns["input_torque"] = gain * columns["input_torque"]
    follower = BalanceFollower(paper())
    follower.add(time, columns)
    *_, last = follower.events
    assert len(follower.events) == 3 and last.causes == () and "stepped 3 times" in last.what


@pytest.mark.parametrize("channel", ["input_speed", "oil_temperature"])
def test_wrong_gains_of_speed_or_oil_give_no_storm_of_events(channel):
    _, time, columns = played("varied", {}, 60.0, 1)
    columns[channel] = 1.05 * columns[channel]
    del columns["output_speed"]  # with both speeds, their ratio is refused
    follower = BalanceFollower(paper())
    follower.add(time, columns)
    assert not follower.events


def test_outliers_and_gaps_do_no_harm():
    _, time, columns = played(
        "reversing", {}, 60.0, 6, sensors={"outlying": 0.02, "lost": 0.05, "clock_offset": 1e-3}
    )
    follower = BalanceFollower(paper())
    follower.add(time, columns)
    friction = named(follower)["friction_level"]
    assert follower.counters.outlying > 50 and not follower.events
    assert friction.low < 1.0 < friction.high


@pytest.mark.exhaustive
@pytest.mark.parametrize("kind", first(1, reversed(DELAYS), pytest.mark.release))
def test_intervals_contain_the_true_value_with_other_laws(kind):
    inside, found = {}, {}
    for seed in range(16):
        law = LAWS[[*LAWS][seed % 4]]
        plant, follower = balance_of(kind, law, 45.0, 100 + seed)
        assert not follower.events
        truth = {"friction_level": friction_level(plant), "inertia": follower.train.inertia}
        errors = plant.hidden.sensors
        truth["drag"] = 0.0
        truth["torque_zero"] = (
            errors.input_torque.zero + follower.train.ratio * errors.output_torque.zero
        )
        for name, value in truth.items():
            one = named(follower)[name]
            if one.status == "ESTIMATED":
                found[name] = found.get(name, 0) + 1
                inside[name] = inside.get(name, 0) + (one.low < value < one.high)
    assert found["friction_level"] == 16
    for name, count in found.items():
        assert inside[name] >= 0.9 * count - 1.0, (name, inside[name], count)


@pytest.mark.release
def test_no_false_alarm_in_ten_minutes_of_each_duty():
    for number, kind in enumerate(DELAYS):
        _, follower = balance_of(kind, LAWS["with bearings"], 600.0, 40 + number)
        assert not follower.events


@pytest.mark.parametrize(
    "factors, question",
    [
        ({}, None),
        ({"input_torque": 1e-3, "output_torque": 1e-3}, "is the unit of both torques right"),
        ({"input_speed": RPM, "output_speed": RPM}, "is the unit of both speeds right"),
    ],
)
def test_a_unit_that_is_wrong_in_both_readings_is_remarked(factors, question):
    scene = paper().replace(input_speed="200 rpm")  # in rpm below the limit of speed in rad/s
    _, time, columns = played("steady", {}, 8.0, 1)
    slow = {"input_speed": 0.2, "output_speed": 0.2}
    columns = {
        name: values * factors.get(name, 1.0) * slow.get(name, 1.0)
        for name, values in columns.items()
    }
    follower = BalanceFollower(scene)
    follower.add(time, columns)
    lines = [line for line in follower.remarks() if "unit" in line]
    assert len(lines) == (question is not None)
    assert all(question in line for line in lines)


@pytest.mark.exhaustive
def test_stamps_in_a_wrong_unit_are_remarked():
    _, time, columns = played("varied", {}, 60.0, 1)
    for factor, remarked in ((1.0, False), (1e3, True)):
        follower = BalanceFollower(paper())
        follower.add(factor * time, columns)
        lines = [line for line in follower.remarks() if "is the unit of the time right" in line]
        assert bool(lines) == remarked
        assert all(line.startswith("readings are 10 s apart") for line in lines)
