"""Readings that no machine has are left out and named; those of a machine pass."""

import numpy as np
import pytest
from following.plants import paper, played

import planetary_twin_py as pt
from planetary_twin_py.following.checks.checked_bins import checked_table
from planetary_twin_py.following.checks.reading_check import ReadingCheck
from planetary_twin_py.following.follower import Follower
from planetary_twin_py.following.loss_map import loss_map
from planetary_twin_py.following.readings import Readings
from planetary_twin_py.following.sensors import Sensors
from planetary_twin_py.following.train import followed_train
from planetary_twin_py.plant.hidden import Hidden
from planetary_twin_py.plant.readings import Plant, simulate_readings

TRAIN = followed_train(paper())
TIME = np.arange(1, 2001) / 100.0
RPM = 30.0 / np.pi


def steady(channel):
    value = {"input_torque": 63.0, "input_speed": 104.72, "oil_temperature": 343.15}[channel]
    return value * (1.0 + 1e-3 * np.sin(1.7 * np.arange(len(TIME))))


def judged(channel, values, split=1, scale=None):
    check = ReadingCheck(TRAIN, Sensors(scale=scale or {}))
    parts = [
        check.judge(time, {channel: part[:, None]}, "rig")[channel][:, 0]
        for time, part in zip(
            np.array_split(TIME, split), np.array_split(values, split), strict=True
        )
    ]
    return np.concatenate(parts), list(check.left_out[0].remarks())


@pytest.mark.parametrize(
    ("channel", "value"),
    [
        ("input_torque", -999.0), ("input_torque", 32767.0), ("input_torque", 9.9e37),
        ("input_torque", -5000.0), ("input_torque", -9999e3), ("input_speed", -9999.0 / RPM),
        ("input_speed", 65535.0), ("oil_temperature", -9999.0 + 273.15), ("oil_temperature", 0.0),
        ("oil_temperature", 273.15),
    ],
)  # fmt: skip
@pytest.mark.parametrize("split", [1, 7])
def test_code_or_a_value_beyond_the_scene_is_left_out_and_named(channel, value, split):
    values = steady(channel)
    values[700:720] = value
    kept, (line,) = judged(channel, values, split)
    assert np.array_equal(np.flatnonzero(np.isnan(kept)), np.arange(700, 720))
    assert line.startswith(f"{channel}: left out, because ") and f": {value:.6g} " in line
    assert "from 7.01 to 7.20 s (20 readings, rows 701 to 720)" in line


@pytest.mark.parametrize("factor", [2.0, 3.0, 0.5])
@pytest.mark.parametrize("split", [1, 13])
def test_a_speed_that_jumps_by_pulses_is_left_out(factor, split):
    values = steady("input_speed")
    wrong = np.arange(2000) % 600 >= 550
    kept, (line,) = judged("input_speed", np.where(wrong, factor * values, values), split)
    assert np.array_equal(np.isnan(kept), wrong)
    assert "pulses" in line and "from 5.51 to 6.00 s (50 readings, rows 551 to 600)" in line


@pytest.mark.parametrize(
    "speed",
    [
        104.72 * np.minimum(TIME / 10.0, 1.0),  # a run-up
        104.72 * np.cos(TIME),  # reversals
        np.where(TIME < 10.0, 50.0, 100.0 - 50.0 * np.exp(-(TIME - 10.0) / 0.05)),  # a fast drive
        np.where(TIME < 10.0, 104.72, 0.0),  # a stop
    ],
    ids=["run-up", "reversals", "fast drive", "stop"],
)
def test_a_real_change_of_the_speed_is_used(speed):
    kept, lines = judged("input_speed", speed)
    assert np.array_equal(kept, speed) and not lines


@pytest.mark.parametrize("split", [1, 13])
def test_a_speed_that_is_zero_between_equal_readings_is_named(split):
    speed = steady("input_speed")
    speed[(TIME > 8.0) & (TIME <= 8.5)] = 0.0
    check = ReadingCheck(TRAIN, Sensors())
    for time, part in zip(np.array_split(TIME, split), np.array_split(speed, split), strict=True):
        kept = check.judge(time, {"input_speed": part[:, None]}, "rig")["input_speed"]
        assert np.array_equal(kept[:, 0], part)  # earlier rows have been passed on as standstill
    (line,) = check.stops.remarks("not used")
    assert line.startswith("input_speed: not used, because it jumps to 0 and back")
    assert "0 rad/s from 8.01 to 8.50 s (50 readings, rows 801 to 850)" in line


@pytest.mark.parametrize(
    "factor",
    [
        np.clip(np.abs(TIME - 8.0) / 0.1 - 1.0, 0.0, 1.0),  # a fast stop, and a fast start
        np.where(TIME < 8.0, 1.0, np.clip((TIME - 9.0) / 0.1, 0.0, 1.0)),  # a brake, and a start
        np.where(np.abs(TIME - 8.0) < 0.5, 1e-3, 1.0),  # not exactly 0
        np.where(TIME < 8.0, 1.0, np.where(TIME < 9.0, 0.0, 0.8)),  # another speed afterwards
    ],
    ids=["ramps", "brake", "slow", "other speed"],
)
def test_a_stop_of_the_machine_is_not_taken_for_a_lost_signal(factor):
    check = ReadingCheck(TRAIN, Sensors())
    speed = steady("input_speed") * factor
    check.judge(TIME, {"input_speed": speed[:, None]}, "rig")
    assert not list(check.stops.remarks())


def test_rows_of_a_lost_speed_are_not_fitted():
    _, time, columns = played("steady", {}, 10.0)
    lost = (time > 5.0) & (time <= 5.5)
    columns["input_speed"][lost] = 0.0
    found = checked_table(paper(), Sensors(), time, columns)
    assert np.array_equal(np.isnan(found.columns["input_speed"]), lost)
    assert any("rows 501 to 550" in line for line in found.remarks)


def paired(input_torque, split):
    check = ReadingCheck(TRAIN, Sensors())
    noise = np.random.default_rng(0).standard_normal(len(TIME))
    load = 63.0 + 5.0 * np.sin(TIME)
    columns = {"input_torque": input_torque(load + 0.1 * noise), "output_torque": 2.3 * load}
    for part in np.array_split(np.arange(len(TIME)), split):
        rows = {name: values[part, None] for name, values in columns.items()}
        check.judge(TIME[part], rows, "rig")
    return list(check.left_out[0].remarks())


@pytest.mark.parametrize("split", [1, 11])
def test_torque_that_is_stuck_while_the_load_changes_is_left_out(split):
    (line,) = paired(lambda torque: np.where(TIME > 10.0, torque[1000], torque), split)
    assert line.startswith("input_torque: left out, because the value repeats exactly")
    assert "20.00 s" in line and "rows 10" in line


@pytest.mark.parametrize(
    "digital",
    [np.round, lambda torque: torque, lambda torque: torque[np.arange(2000) // 20 * 20]],
    ids=["rounded", "noisy", "sampled at a lower rate"],
)
def test_torque_with_equal_readings_that_follows_load_is_used(digital):
    assert not paired(digital, 7)


@pytest.mark.parametrize("at", [0.0, 20.0])
@pytest.mark.parametrize("change", [{"friction": 1.4}, {"drag": 0.036}], ids=["teeth", "drag"])
def test_growth_of_a_loss_of_half_the_torque_is_followed(change, at):
    """The scene alone loses 54 % of this torque, and more than 70 % with the drag."""
    scene = pt.load_scene("compact_actuator").replace(input_torque=0.2)
    sensors = {"input_torque": {"noise": 3e-4}, "output_torque": {"noise": 2e-3}}
    hidden = Hidden.model_validate({"sensors": sensors, "changes": [{"at": at, **change}]})
    plant = Plant(scene, hidden, 40.0)
    time, columns = simulate_readings(plant)
    state = followed(time, columns, scene)
    assert state.counters["implausible"] == 0
    assert not any("contradict" in line for line in state.remarks)
    torque, oil = 0.2, scene.operating_point.oil_temperature
    lost = loss_map(scene)(torque, scene.operating_point.input_speed, oil)
    true = change.get("friction", 1.0) * lost.teeth + lost.rest + change.get("drag", 0.0)
    loss = state["loss_torque"]
    assert loss.status == "ESTIMATED" and loss.low < true < loss.high
    for dead in (0.0, -columns["output_torque"]):
        wrong = np.where((time > 10.0) & (time < 15.0), dead, columns["output_torque"])
        (line,) = (
            line
            for line in followed(time, columns | {"output_torque": wrong}, scene).remarks
            if "left out" in line
        )
        assert line.startswith("output_torque: left out") and "from 10.00 to 15.00 s" in line


@pytest.fixture(scope="module")
def varied():
    _, time, columns = played("varied", {}, 40.0)
    return time, columns, followed(time, columns)


def followed(time, columns, scene=None):
    follower = Follower(scene or paper())
    follower.add(Readings(time, columns))
    follower.finish()
    return follower.estimate()


@pytest.mark.parametrize(
    ("channel", "value"),
    [("input_torque", 1e6), ("output_torque", -9999.0), ("output_torque", 0.0),
     ("input_torque", 0.0), ("input_torque", 300.0)],
)  # fmt: skip
def test_estimates_are_as_without_the_readings(varied, channel, value):
    time, columns, sound = varied
    wrong = np.where((time > 20.0) & (time < 20.155), value, columns[channel])
    state = followed(time, columns | {channel: wrong})
    assert not state.events and state.counters["implausible"] >= 10
    assert [one.status for one in state.estimates] == [one.status for one in sound.estimates]
    level, expected = state["friction_level"], sound["friction_level"]
    assert level.value == pytest.approx(expected.value, abs=0.1 * expected.sd)
    assert any(line.startswith(f"{channel}: left out") for line in state.remarks)
