"""Friction levels and steps of simulated fleets."""

import numpy as np
import pytest
from fleet.fleets import Played, paper
from tiers import first

from planetary_twin_py.fleet.fleet import MOST_STEPS, Fleet

OTHER = {"losses.planet_bearing": {"mean_diameter": 0.012}}


def followed(played, rows, change=None, factor=1.1):
    fleet = Fleet(played.scene, played.count, played.period)
    for number in range(1, rows + 1):
        time = number * played.period
        if change is not None and number == change:
            played.friction[:10] *= factor
        fleet.add(time, played.row(time))
    return fleet


@pytest.mark.exhaustive
@pytest.mark.parametrize("changes", [OTHER, {}], ids=["with bearings", "same law"])
def test_intervals_contain_the_true_friction_level(changes):
    played = Played(300, 1, paper(**changes))
    fleet = followed(played, 600)
    found, true = fleet.estimate("friction_level"), played.level()
    inside = (found.low < true) & (true < found.high)
    assert np.isfinite(found.value).all() and not fleet.events
    assert 0.90 <= inside.mean() <= 0.995
    assert np.std(found.value - true) < 0.15


def test_a_step_of_ten_percent_is_found_and_nothing_else():
    fleet = followed(Played(200, 2), 2400, 1200)
    assert {event.gearbox for event in fleet.events} == set(range(10))
    for event in fleet.events:
        assert 1200.0 < event.found < 1900.0 and event.size > 0.0
        assert 0.0 < event.share < 0.11  # of the step: the filter follows a part of it


def test_rows_of_ten_minutes_show_a_step_and_hold_intervals():
    played = Played(100, 2, period=600.0)
    fleet = followed(played, 200, 100, 1.3)
    assert {event.gearbox for event in fleet.events} == set(range(10))
    assert all(100 < event.found / 600.0 < 150 for event in fleet.events)
    found, true = fleet.estimate("friction_level"), played.level()
    inside = ((found.low < true) & (true < found.high))[10:]
    assert 0.9 <= inside.mean() <= 0.995


@pytest.mark.exhaustive
@pytest.mark.parametrize("gain", [-0.1, 0.1])
def test_a_wrong_gain_is_one_finding_of_one_gearbox(gain):
    played = Played(20, 1)
    played.gain[1][:5] += gain
    fleet = followed(played, 1800)
    assert list(np.flatnonzero(fleet.misfits)) == list(range(5))
    assert [event.gearbox for event in fleet.events] == MOST_STEPS * list(range(5))
    level = fleet.estimate("friction_level")
    assert np.isnan(level.value[:5]).all() and np.isfinite(level.value[5:]).all()


def test_one_direction_identifies_neither_drag_nor_zero_nor_gain():
    fleet = followed(Played(20, 4), 300)
    for name in ("drag", "torque_zero", "torque_gain"):
        assert np.isnan(fleet.estimate(name).value).all()


def test_missing_readings_of_one_gearbox_change_no_other():
    whole, holes = Fleet(paper(), 5), Fleet(paper(), 5)
    played = Played(5, 5)
    for time in range(1, 200):
        row = played.row(float(time))
        whole.add(float(time), row)
        row = {name: values.copy() for name, values in row.items()}
        row["input_torque"][2] = np.nan if time % 2 else row["input_torque"][2]
        holes.add(float(time), row)
    others = [0, 1, 3, 4]
    first, second = whole.estimate("friction_level"), holes.estimate("friction_level")
    assert np.array_equal(first.value[others], second.value[others])
    assert holes.readings[2] < whole.readings[2] and np.isfinite(second.value[2])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"input_torque": np.zeros(2)}, "input_torque: must have 3 values"),
        ({"time": -1.0}, "must be after"),
    ],
)
def test_wrong_rows_are_refused_in_one_line(change, message):
    fleet, played = Fleet(paper(), 3), Played(3, 8)
    fleet.add(0.0, played.row(0.0))
    row = played.row(1.0) | {name: v for name, v in change.items() if name != "time"}
    with pytest.raises(ValueError, match=message):
        fleet.add(change.get("time", 1.0), row)


RPM = 30.0 / np.pi
WRONG = {
    "reversed speed": ({"input_speed": -1.0}, "loss torque = -"),
    "speed in rpm": ({"input_speed": 2.0 * RPM}, "exceeds 1.2 times drive.speed_limit"),
    "degrees Celsius": ({"oil_temperature": 70.0 / 343.15}, "is headed oil_temperature [degC]"),
}


@pytest.mark.parametrize("begin", first(1, [0, 60]))
@pytest.mark.parametrize("what", WRONG)
def test_a_gearbox_with_a_wrong_unit_has_no_estimates(what, begin):
    factors, said = WRONG[what]
    played, good, fleet = Played(4, 9), Fleet(paper(), 4), Fleet(paper(), 4)
    for time in range(1, 201):
        row = played.row(float(time))
        good.add(float(time), row)
        wrong = {name: values.copy() for name, values in row.items()}
        for name, factor in factors.items():
            wrong[name][1] *= factor if time > begin else 1.0
        fleet.add(float(time), wrong)
    fleet.finish()
    assert list(fleet.faults) == [1] and said in fleet.faults[1]
    assert fleet.fits.tolist() == [True, False, True, True]
    level, expected = fleet.estimate("friction_level"), good.estimate("friction_level")
    assert np.isnan(level.value[1])
    others = [0, 2, 3]
    assert np.array_equal(level.value[others], expected.value[others])


@pytest.mark.parametrize(
    ("channel", "value"),
    [("input_torque", -9999.0), ("output_torque", 0.0), ("input_speed", -9999.0 / RPM)],
)
def test_impossible_readings_are_left_out_and_change_nothing(channel, value):
    played, good, fleet = Played(3, 12), Fleet(paper(), 3), Fleet(paper(), 3)
    for time in range(1, 401):
        row = played.row(float(time))
        wrong = {name: values.copy() for name, values in row.items()}
        if 200 < time <= 220:
            wrong[channel][1] = value
            row[channel][1] = np.nan
        good.add(float(time), row)
        fleet.add(float(time), wrong)
    fleet.finish()
    good.finish()
    assert not fleet.events and not fleet.faults and fleet.missing[1] == 20
    level, expected = fleet.estimate("friction_level"), good.estimate("friction_level")
    assert np.array_equal(level.value, expected.value)
    (line,) = fleet.remarks(1)
    assert line.startswith(f"{channel}: left out, because ")
    assert "from 201.00 to 220.00 s (20 readings, rows 201 to 220)" in line


@pytest.mark.parametrize(
    ("channel", "value"),
    [("output_torque", 16777215.0), ("input_speed", 9.9e37), ("oil_temperature", 273.15)],
)
def test_a_gearbox_is_judged_again_after_a_long_outage(channel, value):
    played, fleet = Played(3, 12), Fleet(paper(), 3)
    for time in range(1, 401):
        row = played.row(float(time))
        if 30 < time <= 250:
            row[channel][1] = value
        fleet.add(float(time), row)
        if time == 210 and channel != "oil_temperature":
            assert list(fleet.faults) == [1]
    fleet.finish()
    assert not fleet.events and not fleet.faults and fleet.fits.all()
    assert np.isfinite(fleet.estimate("friction_level").value).all()
    assert "(220 readings, rows 31 to 250)" in fleet.remarks(1)[0]
