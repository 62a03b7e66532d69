"""Clients that command one joint each, die, send too much, or give positions."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from planetary_twin.simulation.diagnostics.commands import COMMANDS
from planetary_twin_msgs.srv import Step
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

import planetary_twin_py as pt

from ..peer import TWIN
from ..reported import statuses
from .test_shaft_commands import NODE, RING, SUN, command, driven, running, speed, torque

COMMANDER = Path(__file__).with_name("commander.py")


@contextmanager
def client(
    joint: str, value: float, rate: float, field: str = "effort"
) -> Iterator[subprocess.Popen[str]]:
    """A client of one joint, in a process of its own."""
    arguments = [joint, field, str(value), str(rate)]
    process = subprocess.Popen(
        [sys.executable, str(COMMANDER), *arguments], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    try:
        assert process.stdout.readline() == "commanding\n"
        yield process
    finally:
        process.kill()
        process.wait()
        process.stdout.close()


def test_a_client_that_dies_is_noticed_while_the_other_goes_on(peer, start, tmp_path):
    """The motor's speed is given by one client, the torque of the load by another one."""
    path = driven(tmp_path, "motion", "torque")
    given = {"command_timeout": 2.0, "command_silence": "zero"}
    start("planetary_twin.simulation", scene=path, **given)
    joints = peer.listen(JointState, f"{TWIN}/joint_states")
    diagnostics = peer.listen(DiagnosticArray, "/diagnostics")
    peer.until(lambda: joints)
    with client(SUN, 104.0, 100.0, "velocity"), client(RING, 145.0, 100.0) as dying:

        def shown() -> tuple[float, float]:
            return speed(joints[-1], SUN), torque(joints[-1], RING)

        peer.until(lambda: shown() == pytest.approx((104.0, 145.0), rel=1e-2))
        dying.kill()
        peer.until(lambda: torque(joints[-1], RING) == 0.0)

        def silent() -> list[DiagnosticStatus]:
            said = statuses(diagnostics, COMMANDS)
            return [s for s in said if s.message.startswith(f"no command for {RING} for")]

        assert peer.until(silent)[-1].level == DiagnosticStatus.WARN
        with client(RING, 140.0, 100.0):  # another one takes its place
            peer.until(lambda: shown() == pytest.approx((104.0, 140.0), rel=1e-2))


def test_several_steps_in_one_call_have_the_bits_of_single_ones(peer, start, tmp_path):
    running(peer, start, tmp_path, rate_factor=0.0, tolerance=0.0)
    peer.pause(NODE)
    assert peer.call(Trigger, f"{NODE}/reset", Trigger.Request()).success
    twin = pt.Twin(pt.load_scene(tmp_path / "driven.yaml"))
    efforts = [(63.0 + n, 147.0 - n) for n in range(20)]
    request = Step.Request(duration=1e-3, commands=[command(effort) for effort in efforts])
    answer = peer.call(Step, f"{NODE}/step", request)
    assert answer.success, answer.message
    assert len(answer.states) == len(efforts)
    stamps = [(s.header.stamp.sec, s.header.stamp.nanosec) for s in answer.states]
    assert stamps == sorted(set(stamps))
    for effort, state in zip(efforts, answer.states, strict=True):
        shown = twin.step(1e-3, input_torque=effort[0], output_torque=effort[1])
        assert list(state.position) == [shown.input_angle, shown.output_angle]
        assert list(state.velocity) == [shown.input_speed, shown.output_speed]
        assert list(state.effort) == [shown.input_torque, shown.output_torque]
    assert answer.state == answer.states[-1]
    assert answer.simulated_time == pytest.approx(0.02, abs=1e-12)

    request.commands[3] = command((1e9, 0.0))
    answer = peer.call(Step, f"{NODE}/step", request)
    assert not answer.success
    assert answer.message.startswith("commands[3]: input_torque = 1000000000.0 N m: must be")
    assert len(answer.states) == 3
    assert answer.simulated_time == pytest.approx(0.023, abs=1e-12)
    request = Step.Request(duration=1.0, commands=[command((63.0, 147.0))] * 11)
    answer = peer.call(Step, f"{NODE}/step", request)
    assert answer.message == "commands: 11 steps of 1 s: must be at most 10 s in total"
