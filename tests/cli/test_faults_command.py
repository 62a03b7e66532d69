"""The command `faults` as typed."""

import json

import pytest
from command_line import succeed

RING = ("--set", "gearset.held=ring", "--set", "drive.output.member=carrier")


def figures(*arguments):
    done = succeed("faults", *arguments, "--json", "-")
    return json.loads(done.stdout)


def printed(*arguments):
    done = succeed("faults", *arguments)
    return done.stdout


def test_orders_are_exact_and_have_the_frequency_of_the_operating_point():
    """paper: 30 teeth of the sun at 1000 rpm, 500 Hz."""
    found = figures("paper")
    assert found["reference"] == "sun"
    mesh = found["orders"]["mesh"]
    assert mesh == {"order": 30.0, "exact": "30", "frequency_hz": pytest.approx(500.0)}
    assert found["orders"]["ring_tooth_all_meshes"]["exact"] == "9/7"


def test_a_bearing_adds_its_parts():
    found = figures("wind_turbine_stage", "--rollers", 14, "--ratio", 0.2)
    rates = {line["fault"]: line["rate"]["order"] for line in found["lines"]}
    assert rates["outer race (planet)"] == pytest.approx(14.215385, abs=1e-6)
    assert rates["inner race (pin)"] == pytest.approx(21.323077, abs=1e-6)


def test_what_a_sensor_sees_is_stated():
    text = printed("wind_turbine_stage")
    assert "104.7143" in text and "103.7143" in text
    assert "13 of 39 teeth of the planet" in text and "windows of 6 teeth separate them" in text
    text = printed("paper", *RING)
    assert "2 of 20 teeth of the planet" in text and "cannot be separated" in text
    assert "3 x sun tooth = 2 x planet tooth = 7 (7)" in text
    assert "planets do not pass a sensor" in printed("paper")
