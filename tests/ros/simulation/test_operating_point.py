"""Users change the operating point by parameters and a service; invalid values change nothing."""

import math
from pathlib import Path

import pytest
from planetary_twin_msgs.msg import OperatingPoint
from planetary_twin_msgs.srv import SetOperatingPoint
from rcl_interfaces.srv import DescribeParameters

import planetary_twin_py as pt

from ..peer import LATCHED, TWIN

ROOT = Path(__file__).parents[3]
NODE = f"{TWIN}/simulation"


def test_values_set_atomically_apply_from_one_instant(user, points):
    values = {"backlash": "3e-7", "lambda_ratio": 2, "input_speed": 200.0}
    assert user.set(NODE, atomically=True, **values).successful
    user.until(lambda: len(points) == 2)
    point = points[-1]
    assert set(point.changed.split(",")) == set(values)
    assert (point.backlash, point.lambda_ratio, point.input_speed) == (3e-7, 2.0, 200.0)
    assert point.simulated_time > points[0].simulated_time


def test_the_service_answers_with_the_instant_of_the_change(user, points):
    service = f"{NODE}/set_operating_point"
    request = SetOperatingPoint.Request(names=["backlash", "lambda_ratio"], values=[3e-7, 1.5])
    answer = user.call(SetOperatingPoint, service, request)
    assert answer.success
    user.until(lambda: len(points) == 2)
    assert answer.simulated_time == points[-1].simulated_time
    assert answer.stamp == points[-1].header.stamp
    assert user.get(NODE, "backlash") == 3e-7
    for names, values, ramp, reason in (
        (["backlash"], [1.0], 0.0, "backlash = "),
        (["gap"], [1.0], 0.0, "'gap'"),
        (["backlash"], [], 0.0, "1 names for 0 values"),
        ([], [], 0.0, "0 names for 0 values"),
        (["backlash"], [4e-7], -1.0, "ramp = "),
        (["backlash"], [4e-7], math.nan, "ramp = "),
        (["backlash"], [4e-7], 1e6, "ramp = "),
    ):
        request = SetOperatingPoint.Request(names=names, values=values, ramp=ramp)
        answer = user.call(SetOperatingPoint, service, request)
        assert not answer.success and answer.message.startswith(reason), answer.message
    assert user.get(NODE, "backlash") == 3e-7
    assert len(points) == 2


def test_the_temperature_of_oil_that_is_a_state_cannot_be_set(peer, start, tmp_path):
    thermal = {
        "oil": {"mass": 0.5},
        "gears": {"to_oil": 300.0},
        "housing": {"mass": 4.0, "area": 0.1, "height": 0.2, "from_oil": 10.0},
    }
    file = tmp_path / "warm.yaml"
    file.write_text(f"base: paper\nthermal: {thermal}\n")
    start("planetary_twin.simulation", scene=str(file))
    result = peer.set(NODE, oil_temperature=330.0)
    assert not result.successful
    assert result.reason.startswith("oil_temperature = 330.0: a state of this scene (thermal)")
    peer.until(lambda: peer.state(NODE) == "active")
    request = SetOperatingPoint.Request(names=["backlash", "oil_temperature"], values=[3e-7, 330.0])
    answer = peer.call(SetOperatingPoint, f"{NODE}/set_operating_point", request)
    assert not answer.success and answer.message == result.reason
    point = pt.load_scene(file).operating_point
    assert peer.get(NODE, "backlash") == point.backlash  # nothing is changed
    request = DescribeParameters.Request(names=["oil_temperature"])
    (described,) = peer.call(DescribeParameters, f"{NODE}/describe_parameters", request).descriptors
    assert described.read_only and "without effect" in described.description
    assert peer.set(NODE, oil_temperature=point.oil_temperature).successful  # as in a dump


def test_a_ramp_reaches_the_values_in_the_requested_time(user, points):
    request = SetOperatingPoint.Request(
        names=["lambda_ratio", "backlash"], values=[2.0, 4e-7], ramp=0.5
    )
    answer = user.call(SetOperatingPoint, f"{NODE}/set_operating_point", request)
    assert answer.success, answer.message
    user.until(lambda: points[-1].lambda_ratio == 2.0)
    settled = len(points)
    on_the_way = points[1:]
    assert 45 <= len(on_the_way) <= 55
    for point in on_the_way:
        # A window uses, from its start, the value that the ramp has at its end.
        share = min((point.simulated_time + 0.01 - answer.simulated_time) / 0.5, 1.0)
        assert math.isclose(point.lambda_ratio, 1.0 + share, abs_tol=1e-9)
        assert math.isclose(point.backlash, 2e-7 + 2e-7 * share, abs_tol=1e-15)
    assert user.get(NODE, "lambda_ratio") == 2.0
    assert user.set(NODE, lambda_ratio=1.0).successful
    user.until(lambda: len(points) == settled + 1)


def test_setting_a_quantity_ends_its_ramp(user, points):
    request = SetOperatingPoint.Request(
        names=["lambda_ratio", "backlash"], values=[2.0, 4e-7], ramp=2.0
    )
    assert user.call(SetOperatingPoint, f"{NODE}/set_operating_point", request).success
    user.until(lambda: len(points) > 5)
    assert user.set(NODE, lambda_ratio=0.5).successful
    user.until(lambda: points[-1].lambda_ratio == 0.5)
    user.until(lambda: points[-1].backlash == 4e-7)
    assert points[-1].lambda_ratio == 0.5


@pytest.mark.parametrize(
    ("file", "given", "name"),
    [("twin.yaml", {"scene": "lightly_loaded"}, "lightly_loaded"), ("paper.yaml", {}, "paper")],
)
def test_shipped_parameter_files_leave_or_state_the_scene_s_values(peer, start, file, given, name):
    path = ROOT / "ros_ws/src/planetary_twin/config" / file
    start("planetary_twin.simulation", "--ros-args", "--params-file", str(path), **given)
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
    point = peer.until(lambda: points, 120.0)[0]
    for field, value in pt.load_scene(name).operating_point:
        assert math.isclose(getattr(point, field), value, rel_tol=1e-6), field
