"""Clients that flood, send nonsense or die cannot stop a twin, nor make it tell what is not so."""

from __future__ import annotations

import itertools
import math
import os
import subprocess
import sys
import time
from array import array
from pathlib import Path

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from lifecycle_msgs.srv import ChangeState, GetState
from planetary_twin_msgs.msg import GearboxState, OperatingPoint
from planetary_twin_msgs.srv import NaturalModes, SetOperatingPoint, Step
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    ListParameters,
    SetParameters,
    SetParametersAtomically,
)
from std_srvs.srv import SetBool, Trigger

from .conftest import Start
from .peer import LONG, TWIN, Peer

NODE = f"{TWIN}/simulation"
READABLE = 300  # characters that a refusal takes at most
MEGABYTE = "x" * 1_000_000
FLOOD = Path(__file__).with_name("flood.py")


class Heard:
    """What a simulation publishes while it is being attacked."""

    def __init__(self, peer: Peer, process: subprocess.Popen[str]) -> None:
        self.process = process
        self.states = peer.listen(GearboxState, f"{TWIN}/gearbox_state", 1000)
        self.reports = peer.listen(DiagnosticArray, "/diagnostics")
        peer.until(lambda: self.states and self.reports)

    def figures(self, report: int = -1) -> dict[str, str]:
        return {item.key: item.value for item in self.reports[report].status[0].values}


@pytest.fixture
def heard(peer: Peer, start: Start) -> Heard:
    return Heard(peer, start("planetary_twin.simulation"))


def flood(clients: int, batch: int) -> list[subprocess.Popen[str]]:
    """Clients that send 10 000 sets a second in all, or as many as they can."""
    command = [sys.executable, str(FLOOD), str(10_000 / clients), str(batch)]
    floods = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(clients)]
    for process in floods:
        assert process.stdout is not None
        assert process.stdout.readline() == "flooding\n"
    return floods


@pytest.mark.parametrize(
    ("clients", "batch"), [(1, 1), pytest.param(3, 50, marks=pytest.mark.exhaustive)]
)
def test_a_flood_of_parameter_sets_neither_stops_the_twin_nor_makes_it_lie(
    peer: Peer, heard: Heard, clients: int, batch: int
) -> None:
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", 1000)
    resident = _resident(heard.process.pid)
    floods = flood(clients, batch)
    try:
        first, told, begin = len(heard.states), len(heard.reports), time.monotonic()
        peer.until(lambda: len(heard.states) > first + 400 and len(heard.reports) > told + 2)
        elapsed = time.monotonic() - begin
        during = heard.states[first:]
        count = len(heard.reports)
        peer.until(lambda: len(heard.reports) > count)
        assert peer.call(GetState, f"{NODE}/get_state", GetState.Request())
    finally:
        for process in floods:  # they die amid their calls
            process.kill()
            process.communicate()
    # The machine is the flood's too, so the twin may fall behind; then it says so.
    simulated = during[-1].simulated_time - during[0].simulated_time
    if simulated < 0.8 * elapsed:  # more than what may still be under way to this process
        assert any(report.status[0].level != b"\0" for report in heard.reports[told:])
    assert [b.sequence - a.sequence for a, b in itertools.pairwise(during)] == [1] * (
        len(during) - 1
    )
    # One change an interval at most: what is set meanwhile holds from the same instant.
    instants = [point.simulated_time for point in points]
    assert len(set(instants)) == len(instants) > 10

    # Requests that were sent are still answered; what is set after them holds.
    peer.until(lambda: _holds(peer, 3.25))
    assert peer.get(NODE, "lambda_ratio") == 3.25
    peer.until(lambda: math.isclose(heard.states[-1].sun_planet_lambda_ratio[0], 3.25))
    assert points[-1].lambda_ratio == 3.25
    later = len(heard.states) + 100
    peer.until(lambda: len(heard.states) > later)
    assert _resident(heard.process.pid) < resident + 60e6


def _holds(peer: Peer, value: float) -> bool:
    """Try to set the value, although the queue may be full of requests."""
    try:
        return peer.set(NODE, lambda_ratio=value).successful
    except AssertionError:
        return False


def _resident(process: int) -> float:
    """Memory of a process [bytes]."""
    pages = int(Path(f"/proc/{process}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def values() -> list[ParameterValue]:
    """One of each type that a number is not, and of types that there are not."""
    return [
        ParameterValue(),
        ParameterValue(type=ParameterType.PARAMETER_BOOL, bool_value=True),
        ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=MEGABYTE),
        ParameterValue(type=ParameterType.PARAMETER_STRING, string_value="1" * 1_000_000),
        ParameterValue(type=ParameterType.PARAMETER_STRING, string_value="\0\n\x1b[2J\u202e"),
        ParameterValue(type=ParameterType.PARAMETER_BYTE_ARRAY, byte_array_value=[b"\0"] * 10_000),
        ParameterValue(type=ParameterType.PARAMETER_BOOL_ARRAY, bool_array_value=[True] * 10_000),
        ParameterValue(
            type=ParameterType.PARAMETER_INTEGER_ARRAY,
            integer_array_value=array("q", range(100_000)),
        ),
        ParameterValue(
            type=ParameterType.PARAMETER_DOUBLE_ARRAY,
            double_array_value=array("d", [1e-7] * 100_000),
        ),
        ParameterValue(
            type=ParameterType.PARAMETER_STRING_ARRAY, string_array_value=["1e-7"] * 10_000
        ),
        ParameterValue(type=99),
        ParameterValue(type=255, double_value=1e-7),
    ]


def test_values_and_names_that_cannot_be_are_refused_in_one_readable_line(
    peer: Peer, heard: Heard
) -> None:
    before = peer.get(NODE, "backlash")
    names = ("backlash", "scene", "use_sim_time", "gearset.teeth.sun")
    others = ("", "\0", "../backlash", "back lash", "röhre\n", "backlash." * 1000, MEGABYTE)
    attempts = [Parameter(name=name, value=value) for name in names for value in values()]
    attempts.pop(len(values()) * 2 + 1)  # use_sim_time may be set to a bool
    good = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=3e-7)
    attempts += [Parameter(name=name, value=good) for name in others]
    valid = Parameter(name="backlash", value=good)
    for attempt in attempts:
        request = SetParameters.Request(parameters=[attempt])
        (result,) = peer.call(SetParameters, f"{NODE}/set_parameters", request).results
        _refused(result.successful, result.reason, attempt.name)
        both = SetParametersAtomically.Request(parameters=[valid, attempt])
        answer = peer.call(SetParametersAtomically, f"{NODE}/set_parameters_atomically", both)
        _refused(answer.result.successful, answer.result.reason, "")
    many = SetParameters.Request(parameters=[valid] * 10_000)
    results = peer.call(SetParameters, f"{NODE}/set_parameters", many).results
    assert len(results) == 10_000
    _refused(results[0].successful, results[0].reason, "10000 parameters")
    assert peer.get(NODE, "backlash") == before
    listed = peer.call(ListParameters, f"{NODE}/list_parameters", ListParameters.Request())
    assert not set(others) & set(listed.result.names)
    _runs_well(peer, heard)


def _refused(successful: bool, reason: str, name: str) -> None:
    assert not successful
    assert 0 < len(reason) < READABLE and reason.isprintable(), reason
    if name.isprintable() and len(name) < 50:
        assert name in reason


def _runs_well(peer: Peer, heard: Heard) -> None:
    """The twin goes on, and has printed nothing that a client has sent."""
    count = len(heard.states)
    peer.until(lambda: len(heard.states) > count + 20)
    heard.process.terminate()
    output, errors = heard.process.communicate(timeout=LONG)
    assert heard.process.returncode == 0, errors
    assert "Traceback" not in errors
    assert all(len(line) < READABLE for line in (output + errors).splitlines())


def test_services_refuse_what_is_too_much_or_makes_no_sense(peer: Peer, heard: Heard) -> None:
    service = f"{NODE}/set_operating_point"
    for names, given in (
        (["backlash"] * 100_000, [3e-7] * 100_000),
        (["backlash"], [3e-7] * 100_000),
        ([MEGABYTE], [1.0]),
        ([""], [1.0]),
        (["tolerance"], [1e-3]),
        (["gearset.module"], [1e-3]),
        (["backlash", "lambda_ratio"], [3e-7, math.inf]),
        (["backlash", "second_input_speed"], [3e-7, 1.0]),
    ):
        request = SetOperatingPoint.Request(names=names, values=given)
        answer = peer.call(SetOperatingPoint, service, request)
        _refused(answer.success, answer.message, "")
    for transition in (b"\xff\xfe".decode("latin-1"), MEGABYTE, "configure"):
        request = ChangeState.Request()
        request.transition.label = transition
        assert not peer.call(ChangeState, f"{NODE}/change_state", request).success
    for kind, name in (
        (GetParameters, "get_parameters"),
        (DescribeParameters, "describe_parameters"),
    ):
        request = kind.Request(names=["", MEGABYTE])
        assert peer.call(kind, f"{NODE}/{name}", request)
    assert peer.get(NODE, "backlash") == 2e-7
    _runs_well(peer, heard)


def test_all_services_at_once_are_all_answered(peer: Peer, heard: Heard) -> None:
    calls = (
        (SetOperatingPoint, "set_operating_point", {"names": ["backlash"], "values": [3e-7]}),
        (SetBool, "pause", {"data": True}),
        (Step, "step", {"duration": 0.02}),
        (Trigger, "reset", {}),
        (NaturalModes, "natural_modes", {}),
        (GetState, "get_state", {}),
        (ListParameters, "list_parameters", {}),
    )
    clients = [peer.node.create_client(kind, f"{NODE}/{name}") for kind, name, _ in calls]
    peer.until(lambda: all(client.service_is_ready() for client in clients))
    peer.set(NODE, backlash=2e-7)  # what comes later does not get lost in discovery
    futures = [
        client.call_async(kind.Request(**fields))
        for _ in range(10)
        for client, (kind, _, fields) in zip(clients, calls, strict=True)
    ]
    peer.until(lambda: all(future.done() for future in futures))
    assert peer.call(SetBool, f"{NODE}/pause", SetBool.Request(data=False)).success
    assert peer.get(NODE, "backlash") == 3e-7
    _runs_well(peer, heard)


@pytest.mark.parametrize(
    ("parameter", "reason"),
    [
        ("name:=../../x", "plain name"),
        ("name:=/tmp/x", "plain name"),
        ("name:=..", "plain name"),
        (f"name:={'n' * 5000}", "plain name"),
        ('topics:=["no topic"]', "topics: 'no topic'"),
        (f"topics:=[{'t' * 5000}]", "topics: "),
    ],
)
def test_no_name_leads_out_of_the_recordings_folder(
    start: Start, tmp_path: Path, parameter: str, reason: str
) -> None:
    name, value = parameter.split(":=")
    file = tmp_path / "given.yaml"
    file.write_text(f"/**:\n  ros__parameters:\n    {name}: {value}\n")
    process = start("planetary_twin.logger", "--ros-args", "--params-file", str(file))
    _, errors = process.communicate(timeout=LONG)
    assert process.returncode == 1
    assert len(errors.strip().splitlines()) == 1
    assert reason in errors and len(errors) < READABLE
    assert set(tmp_path.iterdir()) == {file}


@pytest.mark.parametrize("remapped", ["__node:=../../x", "__ns:=/../x", "__node:=a b"])
def test_a_node_cannot_be_called_by_a_path(start: Start, tmp_path: Path, remapped: str) -> None:
    process = start("planetary_twin.logger", "--ros-args", "-r", remapped)
    _, errors = process.communicate(timeout=LONG)
    assert process.returncode == 1
    assert "Traceback" not in errors
    assert errors.strip().splitlines()[-1].startswith("logger: ")
    assert not list(tmp_path.iterdir())
