"""Clients that flood, send invalid data or die neither stop a twin nor falsify its reports."""

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
READABLE = 300  # longest refusal [characters]
MEGABYTE = "x" * 1_000_000
FLOOD = Path(__file__).with_name("flood.py")


class Received:
    """Messages that a simulation publishes during an attack."""

    def __init__(self, peer: Peer, process: subprocess.Popen[str]) -> None:
        self.process = process
        self.states = peer.listen(GearboxState, f"{TWIN}/gearbox_state", 1000)
        self.reports = peer.listen(DiagnosticArray, "/diagnostics")
        peer.until(lambda: self.states and self.reports)

    def figures(self, report: int = -1) -> dict[str, str]:
        return {item.key: item.value for item in self.reports[report].status[0].values}


@pytest.fixture
def received(peer: Peer, start: Start) -> Received:
    return Received(peer, start("planetary_twin.simulation"))


def flood(clients: int, batch: int) -> list[subprocess.Popen[str]]:
    """Clients that send 10 000 changes per second in total, or as many as they can."""
    command = [sys.executable, str(FLOOD), str(10_000 / clients), str(batch)]
    floods = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(clients)]
    for process in floods:
        assert process.stdout is not None
        assert process.stdout.readline() == "flooding\n"
    return floods


@pytest.mark.exhaustive
@pytest.mark.parametrize(("clients", "batch"), [(1, 1), (3, 50)])
def test_a_flood_of_changes_neither_stops_the_twin_nor_falsifies_its_reports(
    peer: Peer, received: Received, clients: int, batch: int
) -> None:
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", 1000)
    resident = _resident(received.process.pid)
    floods = flood(clients, batch)
    try:
        first, reported, begin = len(received.states), len(received.reports), time.monotonic()
        peer.until(
            lambda: len(received.states) > first + 400 and len(received.reports) > reported + 2
        )
        elapsed = time.monotonic() - begin
        during = received.states[first:]
        count = len(received.reports)
        peer.until(lambda: len(received.reports) > count)
        assert peer.call(GetState, f"{NODE}/get_state", GetState.Request())
    finally:
        for process in floods:  # killed during their calls
            process.kill()
            process.communicate()
    # The flood uses the same machine, so the twin may fall behind, and must report it.
    simulated = during[-1].simulated_time - during[0].simulated_time
    if simulated < 0.8 * elapsed:  # fewer than the messages in transit explain
        assert any(report.status[0].level != b"\0" for report in received.reports[reported:])
    assert [b.sequence - a.sequence for a, b in itertools.pairwise(during)] == [1] * (
        len(during) - 1
    )
    # At most one change per interval: changes within an interval are merged.
    instants = [point.simulated_time for point in points]
    assert len(set(instants)) == len(instants) > 10

    # Pending requests are still answered, and later changes apply.
    peer.until(lambda: _holds(peer, 3.25))
    assert peer.get(NODE, "lambda_ratio") == 3.25
    peer.until(lambda: math.isclose(received.states[-1].sun_planet_lambda_ratio[0], 3.25))
    assert points[-1].lambda_ratio == 3.25
    later = len(received.states) + 100
    peer.until(lambda: len(received.states) > later)
    assert _resident(received.process.pid) < resident + 60e6


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
    """One value of each type that is not a number, and of unknown types."""
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


def test_invalid_values_and_names_are_refused_in_one_readable_line(
    peer: Peer, received: Received
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
    _runs_well(peer, received)


def _refused(successful: bool, reason: str, name: str) -> None:
    assert not successful
    assert 0 < len(reason) < READABLE and reason.isprintable(), reason
    if name.isprintable() and len(name) < 50:
        assert name in reason


def _runs_well(peer: Peer, received: Received) -> None:
    """The twin continues, and has printed nothing that a client has sent."""
    count = len(received.states)
    peer.until(lambda: len(received.states) > count + 20)
    received.process.terminate()
    output, errors = received.process.communicate(timeout=LONG)
    assert received.process.returncode == 0, errors
    assert "Traceback" not in errors
    assert all(len(line) < READABLE for line in (output + errors).splitlines())


def test_services_refuse_excessive_and_invalid_requests(peer: Peer, received: Received) -> None:
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
    _runs_well(peer, received)


def test_simultaneous_requests_are_all_answered(peer: Peer, received: Received) -> None:
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
    peer.set(NODE, backlash=2e-7)  # later requests are not lost in discovery
    futures = [
        client.call_async(kind.Request(**fields))
        for _ in range(10)
        for client, (kind, _, fields) in zip(clients, calls, strict=True)
    ]
    peer.until(lambda: all(future.done() for future in futures))
    assert peer.call(SetBool, f"{NODE}/pause", SetBool.Request(data=False)).success
    assert peer.get(NODE, "backlash") == 3e-7
    _runs_well(peer, received)


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
def test_no_name_leads_out_of_the_folder_of_recordings(
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
def test_a_node_name_must_not_be_a_path(start: Start, tmp_path: Path, remapped: str) -> None:
    process = start("planetary_twin.logger", "--ros-args", "-r", remapped)
    _, errors = process.communicate(timeout=LONG)
    assert process.returncode == 1
    assert "Traceback" not in errors
    assert errors.strip().splitlines()[-1].startswith("logger: ")
    assert not list(tmp_path.iterdir())
