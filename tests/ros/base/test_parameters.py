"""Every quantity has a description and a range; the geometry is read-only."""

from typing import get_args

from planetary_twin_msgs.srv import SetOperatingPoint
from pydantic import BaseModel
from rcl_interfaces.msg import ParameterDescriptor
from rcl_interfaces.srv import DescribeParameters, ListParameters

import planetary_twin_py as pt
from planetary_twin_py.scene.drive import Causality

from ..peer import TWIN, Peer
from ..programs import ended

NODE = f"{TWIN}/simulation"
ROS = ("use_sim_time", "start_type_description_service")  # declared by rclpy


def leaves(prefix: str, section: BaseModel) -> dict[str, object]:
    """Every value in a scene's section, by dotted name."""
    found: dict[str, object] = {}
    for name, value in section:
        path = f"{prefix}.{name}"
        found |= leaves(path, value) if isinstance(value, BaseModel) else {path: value}
    return found


def described(peer: Peer) -> dict[str, ParameterDescriptor]:
    names = peer.call(ListParameters, f"{NODE}/list_parameters", ListParameters.Request())
    request = DescribeParameters.Request(names=names.result.names)
    answer = peer.call(DescribeParameters, f"{NODE}/describe_parameters", request)
    return dict(zip(names.result.names, answer.descriptors, strict=True))


def test_every_parameter_has_a_description_and_constraints(user, points):
    own = {name: descriptor for name, descriptor in described(user).items() if name not in ROS}
    for name, descriptor in own.items():
        assert (
            descriptor.name == name and descriptor.description and descriptor.additional_constraints
        ), name
    settable = {name for name, descriptor in own.items() if not descriptor.read_only}
    assert settable == {*pt.TUNABLES, "drive.input.port", "drive.output.port", "tolerance"}
    for name, tunable in pt.load_scene("paper").tunables.items():
        (limits,) = own[name].floating_point_range
        assert (limits.from_value, limits.to_value) == (tunable.minimum, tunable.maximum)
        assert f"[{tunable.unit or '-'}]" in own[name].description

    for side, refused in (("input", set()), ("output", {"brake"})):
        allowed = set(get_args(Causality)) - refused
        named = own[f"drive.{side}.port"].description.partition(": ")[2]
        assert set(named.split(", ")) == allowed


def test_geometry_is_that_of_the_scene_and_cannot_be_set(user, points):
    every = leaves("gearset", pt.load_scene("paper").gearset)
    geometry = {name: value for name, value in every.items() if value is not None}
    descriptors = described(user)
    assert {name for name in descriptors if name.startswith("gearset.")} == set(geometry)
    values = user.parameters(NODE, *geometry)
    for (name, expected), given in zip(geometry.items(), values, strict=True):
        assert (tuple(given) if isinstance(expected, tuple) else given) == expected
        assert descriptors[name].read_only
        result = user.set(NODE, **{name: "other" if isinstance(expected, str) else 0.123})
        assert not result.successful
        assert result.reason.startswith(f"{name} = ")
        assert "choose another scene" in result.reason
    both = {"backlash": 3e-7, "gearset.module": 1e-3}
    assert not user.set(NODE, atomically=True, **both).successful
    assert user.get(NODE, "backlash") == 2e-7


REFUSED: tuple[tuple[str, object, tuple[str, ...]], ...] = (
    ("backlash", -1.0, ("backlash = -1.0 m: must be a number within 0 and 0.001 m",)),
    (
        "tolerance",
        0.5,
        ("tolerance = 0.5: must be a number within 0 and 0.1 (", "1e-08 to 0.1; 0:"),
    ),
    ("lambda_ratio", True, ("True", "number")),
    ("scene", "other", ("'other'", "fixed")),
    ("oil_temperature", 20, ("20", "233.15")),
    ("second_input_speed", 1.0, ("1.0", "must be 0 without a second input")),
    ("rate_factor", 2.0, ("2.0", "fixed", "-p rate_factor:=")),
    ("use_sim_time", "yes", ("'yes'", "BOOL")),
    ("gap", 1.0, ("no such parameter",)),
)


def test_a_refusal_names_field_value_and_range(user, points):
    for name, value, reason in REFUSED:
        for given in ({name: value}, {"torque_ripple": 1.0, name: value}):
            result = user.set(NODE, atomically=len(given) == 2, **given)
            assert not result.successful
            assert all(part in result.reason for part in (name, *reason)), result.reason
    assert len(points) == 1
    assert user.get(NODE, "torque_ripple") == 0.0
    assert user.set(NODE, torque_ripple=0.5).successful
    user.until(lambda: len(points) == 2)
    assert points[-1].changed == "torque_ripple"


def test_a_quantity_without_effect_comes_with_a_remark(peer, start):
    start("planetary_twin.simulation", scene="wind_turbine_stage")
    remark = "lambda_ratio: has no effect: the scene computes it"
    result = peer.set(NODE, lambda_ratio=1.2)
    assert result.successful and result.reason.startswith(remark)
    assert peer.set(NODE, oil_temperature=330.0).reason == ""
    peer.until(lambda: peer.state(NODE) == "active")
    request = SetOperatingPoint.Request(names=["lambda_ratio"], values=[1.3])
    answer = peer.call(SetOperatingPoint, f"{NODE}/set_operating_point", request)
    assert answer.success and answer.message.startswith(remark)


def test_a_start_value_of_the_geometry_must_be_the_scene_s(start):
    process = start("planetary_twin.simulation", "--ros-args", "-p", "gearset.teeth.sun:=31")
    errors = ended(process, 1)
    assert errors.startswith("simulation: gearset.teeth.sun = 31: geometry is fixed")
    assert len(errors.strip().splitlines()) == 1
