"""A twin driven by other programs: ~/command, lockstep by ~/step, torques of the joints."""

import math
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from planetary_twin.simulation.diagnostics.commands import COMMANDS
from planetary_twin.simulation.shaft_commands import ShaftCommands, fault_of_names
from planetary_twin_msgs.srv import Step
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

import planetary_twin_py as pt
from planetary_twin_py.recording.runs.schedule import read_runs

from ..conftest import Start
from ..peer import TWIN, Peer
from ..reported import check_verified, statuses

NODE = f"{TWIN}/simulation"
PAPER = pt.load_scene("paper")
SUN, RING = "sun_joint", "ring_joint"


def driven(folder: Path, input: str, output: str) -> str:
    """A scene file with these ports."""
    path = folder / "driven.yaml"
    ports = f"{{input: {{port: {input}}}, output: {{port: {output}}}}}"
    path.write_text(f"base: paper\nname: driven\ndrive: {ports}\n")
    return str(path)


def command(effort: tuple[float, float], stamp: int = 0) -> JointState:
    """Torques on both shafts [N m], stamped [ns]."""
    message = JointState(name=[SUN, RING], effort=list(effort))
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, 1_000_000_000)
    return message


def running(peer: Peer, start: Start, folder: Path, **given: Any) -> list[JointState]:
    """Joint states of a simulation whose torques are given."""
    start("planetary_twin.simulation", scene=driven(folder, "torque", "torque"), **given)
    joints = peer.listen(JointState, f"{TWIN}/joint_states")
    peer.until(lambda: joints)
    return joints


def torque(message: JointState, joint: str) -> float:
    return message.effort[list(message.name).index(joint)]


def speed(message: JointState, joint: str) -> float:
    return message.velocity[list(message.name).index(joint)]


def test_lockstep_has_the_bits_of_a_twin_in_python(peer, start, tmp_path):
    """Pause, reset, then commands in and states out, one call a step, at any load."""
    joints = running(peer, start, tmp_path, tolerance=0.0, compute_share=0.9)
    peer.until(lambda: len(joints) > 200)  # the tolerance has been selected by the load
    peer.pause(NODE)
    assert peer.call(Trigger, f"{NODE}/reset", Trigger.Request()).success
    twin = pt.Twin(pt.load_scene(tmp_path / "driven.yaml"))
    rng, begin, calls = np.random.default_rng(3), time.monotonic(), 300
    for _ in range(calls):
        effort = (63.0 + 9.0 * rng.standard_normal(), 147.0 + 9.0 * rng.standard_normal())
        request = Step.Request(duration=1e-3, command=command(effort))
        answer = peer.call(Step, f"{NODE}/step", request)
        assert answer.success, answer.message
        shown = twin.step(1e-3, input_torque=effort[0], output_torque=effort[1])
        state = answer.state
        assert list(state.name) == [SUN, RING]
        assert list(state.position) == [shown.input_angle, shown.output_angle]
        assert list(state.velocity) == [shown.input_speed, shown.output_speed]
        assert list(state.effort) == [shown.input_torque, shown.output_torque]
        assert answer.simulated_time == pytest.approx(shown.time, abs=1e-12)
    print(f"{calls / (time.monotonic() - begin):.0f} lockstep calls a second")
    # The same by topic: the command that arrived last acts in the next step.
    publisher = peer.node.create_publisher(JointState, f"{NODE}/command", 10)
    diagnostics = peer.listen(DiagnosticArray, "/diagnostics")

    def is_received() -> bool:  # the first ones are lost if the node has not discovered us yet
        publisher.publish(command((50.0, 120.0)))
        return any(each.message == "received" for each in statuses(diagnostics, COMMANDS))

    count = len(joints)
    peer.until(is_received)
    answer = peer.call(Step, f"{NODE}/step", Step.Request(duration=1e-3))
    shown = twin.step(1e-3, input_torque=50.0, output_torque=120.0)
    assert list(answer.state.velocity) == [shown.input_speed, shown.output_speed]
    assert list(answer.state.effort) == [50.0, 120.0]
    peer.until(lambda: len(joints) > count)


def test_steps_with_a_command_that_no_port_takes_are_refused(peer, start, tmp_path):
    running(peer, start, tmp_path, rate_factor=0.0, tolerance=0.0)
    peer.pause(NODE)
    now = peer.call(Step, f"{NODE}/step", Step.Request(duration=1e-3)).simulated_time
    for request, reason in (
        (command((1e9, 0.0)), "input_torque = 1000000000.0 N m: must be within"),
        (JointState(name=[RING], velocity=[1.0]), "output_speed = 1.0: requires drive.output.port"),
        (
            JointState(name=["elbow"], effort=[1.0]),
            "command: must have an effort, velocity or position of "
            f"{SUN} or {RING}; the command names 'elbow'",
        ),
        (JointState(name=[SUN], effort=[1.0, 2.0]), "command: has more values than names"),
        (JointState(effort=[1.0]), "command: has more values than names"),
        (JointState(name=[SUN, SUN], effort=[1.0, 2.0]), "command: has a name twice"),
    ):
        answer = peer.call(Step, f"{NODE}/step", Step.Request(duration=1e-3, command=request))
        assert not answer.success
        assert answer.message.startswith(reason)
        assert answer.simulated_time == now > 0.0
    answer = peer.call(Step, f"{NODE}/step", Step.Request(duration=1e-12))
    assert answer.message == "duration = 1e-12 s: must be within 1e-06 and 10 s"
    assert answer.simulated_time == now
    both = Step.Request(duration=1e-3, command=command((1.0, 0.0)), commands=[command((1.0, 0.0))])
    answer = peer.call(Step, f"{NODE}/step", both)
    assert answer.message == "command: must be empty if there are commands"


def received(
    *messages: JointState,
    timeout: float = 0.0,
    silence: str = "hold",
    continuous: bool = False,
    now: Callable[[], int] = lambda: 1_000,
) -> ShaftCommands:
    settings = SimpleNamespace(
        command_timeout=timeout, command_silence=silence, continuous_joints=continuous
    )
    commands = ShaftCommands(PAPER, settings, now, take=lambda: ())
    for message in messages:
        commands.receive(message)
    return commands


def twin(input: str = "torque", output: str = "torque") -> pt.Twin:
    return pt.Twin(PAPER.replace(**{"drive.input.port": input, "drive.output.port": output}))


def torques(commands: ShaftCommands) -> dict[str, float]:
    return commands.given(twin(), 0.01)


def test_repeated_and_reordered_commands_have_no_effect():
    commands = received(
        command((1.0, 2.0), 5),
        command((3.0, 4.0), 5),
        command((5.0, 6.0), 4),
        command((7.0, 8.0), 6),
    )
    assert torques(commands) == {"input_torque": 7.0, "output_torque": 8.0}
    assert commands.ignored == {"repeated or out of order": 2}
    assert torques(commands) == {}


def test_silence_holds_the_last_command_by_default(clock):
    commands = received(command((63.0, 147.0)), timeout=0.5)
    assert torques(commands) == {"input_torque": 63.0, "output_torque": 147.0}
    clock[0] = 0.6
    assert torques(commands) == {}
    silent = "no command for sun_joint and ring_joint for 0.6 s: hold"
    assert commands.row().message == silent


def test_a_fault_is_reported_once_with_its_reason():
    commands = received(command((1.0, 2.0)), command((1e9, 2.0)))
    assert torques(commands) == {"output_torque": 2.0}
    first, second = commands.row(), commands.row()
    assert (ord(first.level), ord(second.level)) == (1, 0)
    assert first.message.startswith(
        "without effect since the last report: 1 out of range (input_torque = 1000000000.0 N m: "
        "must be within"
    )
    assert second.message == "received; none yet for sun_joint"
    assert second.values == {"ignored: out of range": 1}


def test_a_joint_named_twice_discards_a_command():
    other = JointState(name=["elbow", SUN, "elbow"], effort=[7.0, 5.0, 8.0])
    assert fault_of_names(other, (SUN, RING)) == ""
    own = JointState(name=[SUN, RING, SUN], effort=[1.0, 2.0, 3.0])
    assert fault_of_names(own, (SUN, RING)) == "a name twice"
    commands = received(other, own)
    assert torques(commands) == {"input_torque": 5.0}
    assert commands.ignored == {"a name twice": 1}


def test_messages_with_fewer_values_than_names_are_counted():
    """ros2_control sends them, if only the first joint has a command."""
    commands = received(JointState(name=[SUN, RING], effort=[1.0]))
    assert torques(commands) == {"input_torque": 1.0}
    status = commands.row()
    assert (ord(status.level), status.message) == (0, "received; none yet for ring_joint")
    assert status.values == {"fewer values than names": 1}


def test_a_shaft_faster_than_the_limit_of_commands_is_reported():
    ports = {"drive.input.port": "torque", "drive.output.port": "torque"}
    fast = pt.Twin(PAPER.replace(**ports, **{"drive.speed_limit": 105.0}))
    commands = received()
    for _ in range(8):
        fast.advance(0.01, **commands.given(fast, 0.01), input_torque=150.0)
    assert fast.port_states.input_speed > 105.0
    commands.given(fast, 0.01)
    status = commands.row()
    assert ord(status.level) == 1
    assert status.message.startswith("speed of the input shaft = ")
    assert "rad/s: exceeds 105 rad/s, from drive.speed_limit; speed of the output" in status.message


def test_a_command_that_waited_to_be_taken_is_not_late():
    """A paused twin takes commands a few times a second only."""
    now = 10**18
    commands = received(timeout=1.0, now=lambda: now)
    commands.receive(command((1.0, 2.0), now - 3_000_000_000), waited=2_500_000_000)
    assert torques(commands) == {"input_torque": 1.0, "output_torque": 2.0}


def test_a_command_ahead_of_the_clock_leaves_later_ones():
    now = 10**18
    commands = received(
        command((1.0, 2.0), now + 3600 * 10**9), command((3.0, 4.0), now), now=lambda: now
    )
    assert torques(commands) == {"input_torque": 3.0, "output_torque": 4.0}
    assert commands.ignored == {"ahead of the clock": 1}


def test_commands_act_after_the_clock_was_set_back():
    now = 10**18
    commands = received(command((1.0, 2.0), now), now=lambda: now)
    now -= 3600 * 10**9
    commands.receive(command((3.0, 4.0), now))
    assert torques(commands) == {"input_torque": 3.0, "output_torque": 4.0}
    assert not commands.ignored


def test_each_joint_may_have_a_client_of_its_own(clock):
    """Stamps and silence of one joint say nothing of the other."""
    sun, ring = JointState(name=[SUN], effort=[5.0]), JointState(name=[RING], effort=[7.0])
    sun.header.stamp.nanosec, ring.header.stamp.nanosec = 20, 10
    commands = received(sun, ring)
    assert torques(commands) == {"input_torque": 5.0, "output_torque": 7.0}
    assert not commands.ignored
    watched = received(command((5.0, 7.0)), timeout=0.5, silence="zero")
    torques(watched)
    clock[0] = 0.6
    watched.receive(JointState(name=[SUN], effort=[6.0]))
    assert torques(watched) == {"input_torque": 6.0, "output_torque": 0.0}
    assert f"no command for {RING} for" in watched.row().message


@pytest.mark.parametrize(
    "refused",
    [command((1e9, -1e9)), JointState(name=[SUN, RING], velocity=[1.0, 1.0])],
    ids=["out of range", "not of the port"],
)
def test_refused_commands_do_not_keep_a_brake_off(clock, refused):
    commands, braked = received(command((63.0, 147.0)), timeout=0.5, silence="brake"), twin()
    commands.given(braked, 0.01)
    for clock[0] in (0.3, 0.6):
        commands.receive(refused)
        assert commands.given(braked, 0.01) == {}
    assert braked.ports == ("brake", "torque")
    commands.receive(refused)
    assert commands.given(braked, 0.01) == {}
    assert braked.ports == ("brake", "torque")


def test_a_brake_lasts_while_one_joint_has_no_command(clock):
    commands, braked = received(command((63.0, 147.0)), timeout=0.5, silence="brake"), twin()
    assert commands.given(braked, 0.01) == {"input_torque": 63.0, "output_torque": 147.0}
    clock[0] = 0.6
    commands.receive(JointState(name=[SUN], effort=[60.0]))
    assert commands.given(braked, 0.01) == {}
    assert braked.ports == ("brake", "torque")
    status = commands.row()
    assert (status.level, status.message[-7:]) == (DiagnosticStatus.ERROR, ": brake")
    commands.receive(command((61.0, 140.0)))
    assert commands.given(braked, 0.01) == {"input_torque": 61.0, "output_torque": 140.0}
    assert braked.ports == ("torque", "torque")


def test_the_end_of_a_brake_names_what_acts_at_both_ports(clock):
    """A recording then has the ports, also where the next command is for one of them."""
    braked = twin("torque", "motion")
    commands = received(
        JointState(name=[SUN, RING], effort=[63.0, math.nan], velocity=[math.nan, -44.88]),
        timeout=0.5,
        silence="brake",
    )
    commands.given(braked, 0.01)
    clock[0] = 0.6
    braked.advance(0.01, **commands.given(braked, 0.01))
    assert braked.ports == ("brake", "torque")
    speed = braked.port_states.output_speed
    commands.receive(JointState(name=[RING], velocity=[speed]))
    commands.receive(JointState(name=[SUN], effort=[50.0]))
    given = commands.given(braked, 0.01)
    assert given == {"input_torque": 50.0, "output_speed": speed}
    assert braked.ports == ("torque", "motion")


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("output", ["torque", "motion", "machine"])
@pytest.mark.parametrize("input", ["torque", "motion"])
def test_silence_brakes_far_beyond_the_limit_of_commands(clock, input, output, sign):
    """Interval by interval as a node does, with an error until the shaft is at rest."""
    limit, slew = 50.0, PAPER.drive.speed_control.slew_rate
    fast = pt.Twin(
        PAPER.replace(
            input_speed=0.0,
            **{
                "drive.input.port": input,
                "drive.output.port": output,
                "drive.speed_limit": limit,
                "drive.speed_control.start_speed": sign * 3.0 * limit,
            },
        )
    )
    value = {"effort": [1.0]} if input == "torque" else {"velocity": [sign * limit]}
    commands = received(JointState(name=[SUN], **value), timeout=0.5, silence="brake")
    taken = commands.given(fast, 0.01)
    assert len(taken) == 1
    clock[0] = 0.6
    fast.advance(0.01, **commands.given(fast, 0.01))
    before = abs(fast.port_states.input_speed)
    assert before == pytest.approx(3.0 * limit - 0.01 * slew, rel=0.05)
    while before > 0.02 * slew:
        fast.advance(0.01, **commands.given(fast, 0.01))
        now = abs(fast.port_states.input_speed)
        assert before - now == pytest.approx(0.01 * slew, rel=1e-6)
        before = now
        assert commands.row().level == DiagnosticStatus.ERROR
    fast.advance(0.1, **commands.given(fast, 0.01))
    assert abs(fast.port_states.input_speed) < 1e-9


def test_a_defect_in_taking_commands_is_a_silence(clock):
    """The thread of the twin goes on, and brakes; without a client, too."""
    commands, braked = received(command((63.0, 147.0)), timeout=0.5, silence="brake"), twin()
    commands.given(braked, 0.01)

    def fail() -> list[tuple[int, JointState]]:
        raise RuntimeError("the middleware is gone")

    commands._take = fail
    clock[0] = 0.6
    assert commands.given(braked, 0.01) == {}
    assert braked.ports == ("brake", "torque")
    assert "not taken (RuntimeError: the middleware is gone)" in commands.row().message


@pytest.mark.parametrize("continuous", [False, True])
def test_positions_are_those_of_joint_states(continuous):
    """Within one turn, the nearest angle is meant; with `continuous_joints`, the angle itself."""
    moved = twin("motion", "torque")
    moved.advance(0.1)  # more than a turn and a half
    angle = moved.port_states.input_angle
    assert angle > 1.5 * 2.0 * math.pi
    within_a_turn = math.remainder(angle, 2.0 * math.pi) + 0.1
    message = JointState(name=[SUN], position=[angle + 0.1 if continuous else within_a_turn])
    given = received(message, continuous=continuous).given(moved, 0.01)
    assert given == {"input_position": pytest.approx(angle + 0.1, abs=1e-12)}
    if continuous:
        far = received(JointState(name=[SUN], position=[within_a_turn]), continuous=True)
        assert far.given(moved, 0.01) == {}
        assert far.ignored == {"out of range": 1}


def test_values_that_are_missing_or_nan_leave_a_port_as_it_is():
    half = JointState(name=["other", RING, SUN], effort=[1.0, 2.0])
    assert torques(received(half)) == {"output_torque": 2.0}
    assert torques(received(command((math.nan, 5.0)))) == {"output_torque": 5.0}
    empty = received(JointState(name=[SUN], position=[math.nan]))
    assert torques(empty) == {}
    reason = "no effort, velocity or position of sun_joint or ring_joint"
    assert empty.ignored == {reason: 1}


def test_a_driven_run_is_recorded_and_verified_bit_for_bit(peer, start, tmp_path):
    """Commands at 1 kHz are in the recording as they acted, and a brake in between."""
    logger = start("planetary_twin.logger", name="driven")
    joints = running(
        peer, start, tmp_path, wait_for="logger", command_timeout=0.3, command_silence="brake"
    )
    reports = peer.listen(DiagnosticArray, "/diagnostics")
    publisher = peer.node.create_publisher(JointState, f"{NODE}/command", 10)
    peer.until(lambda: publisher.get_subscription_count() == 1)
    for n in range(400):
        publisher.publish(command((63.0 + math.sin(0.1 * n), 147.0 + math.cos(0.2 * n))))
        time.sleep(1e-3)
    reports.clear()
    peer.until(lambda: any(s.message.endswith("s: brake") for s in statuses(reports, COMMANDS)))
    peer.until(lambda: abs(speed(joints[-1], SUN)) < 30.0)
    for n in range(100):
        publisher.publish(command((20.0 + 0.1 * n, 40.0)))
        time.sleep(1e-3)
    check_verified(logger, folder := tmp_path / "recordings/driven")
    (run,) = read_runs(folder, TWIN, [])
    assert len(run.given) > 20
    ports = [change.values["drive.input.port"] for change in run.changes]
    assert ports == ["torque", "brake", "torque"]
