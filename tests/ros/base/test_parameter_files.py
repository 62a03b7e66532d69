"""A file written by `ros2 param dump` restores its values, at the start and at run time."""

from pathlib import Path
from typing import Any

import pytest
import yaml
from ament_index_python.packages import get_package_share_directory
from planetary_twin_msgs.msg import GearboxState
from rcl_interfaces.msg import Parameter, ParameterType, SetParametersResult
from rcl_interfaces.srv import (
    ListParameters,
    SetParameters,
    SetParametersAtomically,
)
from rclpy.parameter import parameter_dict_from_yaml_file

from ..peer import LONG, TWIN, Peer

NODE = f"{TWIN}/simulation"
# As users type them: ROS reads an exponent without a point as text, a whole number as an integer.
TYPED = {"backlash": "3e-7", "lambda_ratio": "2", "tolerance": "1e-4", "publish_rate": "50"}
OTHERS = {"backlash": 1e-7, "lambda_ratio": 1.0, "tolerance": 1e-3, "input_torque": 20.0}


def values(peer: Peer) -> dict[str, Any]:
    """All parameters."""
    names = peer.call(ListParameters, f"{NODE}/list_parameters", ListParameters.Request())
    ordered = sorted(names.result.names)
    return dict(zip(ordered, peer.parameters(NODE, *ordered), strict=True))


def dump(peer: Peer, file: Path) -> dict[str, Any]:
    """Write the parameters as `ros2 param dump` does."""
    dumped = values(peer)
    tree: dict[str, Any] = {}
    for name, value in dumped.items():
        *groups, last = name.split(".")
        place = tree
        for group in groups:
            place = place.setdefault(group, {})
        place[last] = value
    file.write_text(yaml.dump({NODE: {"ros__parameters": tree}}), encoding="utf-8")
    return dumped


def as_loaded(file: Path) -> list[Parameter]:
    """The parameters that `ros2 param load` sends, as rclpy reads the file."""
    return list(parameter_dict_from_yaml_file(str(file), True).values())


def set_all(peer: Peer, parameters: list[Parameter]) -> SetParametersResult:
    request = SetParametersAtomically.Request(parameters=parameters)
    return peer.call(SetParametersAtomically, f"{NODE}/set_parameters_atomically", request).result


def test_a_dumped_file_restores_its_values(peer, start, tmp_path):
    first = start("planetary_twin.simulation", **TYPED)
    file = tmp_path / "dumped.yaml"
    dumped = dump(peer, file)
    assert {name: dumped[name] for name in TYPED} == {
        name: pytest.approx(float(value)) for name, value in TYPED.items()
    }
    first.terminate()
    assert first.wait(LONG) == 0

    start("planetary_twin.simulation", "--ros-args", "--params-file", str(file))
    assert values(peer) == dumped

    sent = as_loaded(file)
    types = {parameter.name: parameter.value.type for parameter in sent}
    assert types["backlash"] == ParameterType.PARAMETER_STRING

    for name, value in OTHERS.items():
        assert peer.set(NODE, **{name: value}).successful
    assert values(peer) != dumped
    request = SetParameters.Request(parameters=sent)
    results = peer.call(SetParameters, f"{NODE}/set_parameters", request).results
    assert [result.reason for result in results if not result.successful] == []
    assert values(peer) == dumped

    assert peer.set(NODE, atomically=True, **OTHERS).successful
    answer = set_all(peer, sent)
    assert answer.successful, answer.reason
    assert values(peer) == dumped


def test_only_unknown_start_parameters_cause_a_warning(peer, start):
    """All parameters of the packaged file are known."""
    config = Path(get_package_share_directory("planetary_twin")) / "config" / "paper.yaml"
    given = ("--ros-args", "--params-file", str(config))
    process = start("planetary_twin.twin", *given, backlsh="3e-7", zzz=1)
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    peer.until(lambda: states)
    process.terminate()
    _, log = process.communicate(timeout=LONG)
    warnings = [line for line in log.splitlines() if "no such parameter" in line]
    assert len(warnings) == 2
    assert warnings[0].endswith("backlsh: no such parameter; did you mean backlash?")
    assert warnings[1].endswith("zzz: no such parameter")
