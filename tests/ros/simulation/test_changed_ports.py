"""Users change the ports of a running twin by parameters; the recording repeats the run."""

import math

import numpy as np
import pytest
from planetary_twin_msgs.msg import OperatingPoint
from sensor_msgs.msg import JointState

import planetary_twin_py as pt
from planetary_twin_py.recording.runs.branch import Branch
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.schedule import read_runs
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.recording.runs.what_if import resimulate

from ..peer import LATCHED, TWIN
from ..reported import check_verified
from .test_shaft_commands import RING, SUN, received, torque

NODE = f"{TWIN}/simulation"
INPUT, OUTPUT = "drive.input.port", "drive.output.port"
PAPER = pt.load_scene("paper")


def ports(point: OperatingPoint) -> tuple[str, str]:
    return point.input_port, point.output_port


def test_ports_change_while_the_node_runs_and_verify(peer, start, tmp_path):
    """Two machines, then torque and motion from outside, then machines again."""
    logger = start("planetary_twin.logger", name="changed")
    start("planetary_twin.simulation", wait_for="logger")
    joints = peer.listen(JointState, f"{TWIN}/joint_states")
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
    publisher = peer.node.create_publisher(JointState, f"{NODE}/command", 10)
    peer.until(lambda: len(joints) > 20 and points and publisher.get_subscription_count() == 1)
    assert ports(points[-1]) == ("machine", "machine")
    changes = {INPUT: "torque", OUTPUT: "motion", "lambda_ratio": 1.5}
    assert peer.set(NODE, atomically=True, **changes).successful
    peer.until(lambda: ports(points[-1]) == ("torque", "motion"))
    assert set(points[-1].changed.split(",")) == {"input_port", "output_port", "lambda_ratio"}
    assert points[-1].lambda_ratio == 1.5
    given = JointState(name=[SUN, RING], effort=[66.0, math.nan], velocity=[math.nan, -44.5])

    def follows() -> bool:
        publisher.publish(given)
        return torque(joints[-1], SUN) == pytest.approx(66.0)

    peer.until(follows)
    assert torque(joints[-1], RING) == pytest.approx(147.0, rel=0.2)  # of the shaft, a result
    for side in (INPUT, OUTPUT):
        assert peer.set(NODE, **{side: "machine"}).successful
    peer.until(lambda: ports(points[-1]) == ("machine", "machine"))
    count = len(joints)
    peer.until(lambda: len(joints) > count + 20)
    check_verified(logger, folder := tmp_path / "recordings/changed")
    (run,) = read_runs(folder, TWIN, [])
    inputs = [change.values[INPUT] for change in run.changes]
    assert inputs[:2] == ["machine", "torque"] and inputs[-1] == "machine"
    assert {"input_torque", "output_speed"} <= {k for each in run.given.values() for k in each}
    sun = read_recording(folder).state["sun_speed"]
    assert np.abs(np.diff(sun)).max() < 0.1 * pt.rpm(1000)
    made = resimulate(folder, TWIN, Branch({"lambda_ratio": 2.0}, 0.1), tmp_path / "branch")
    assert verify(made.file.parent, TWIN).identical


def twin(input: str = "machine", output: str = "machine") -> pt.Twin:
    return pt.Twin(PAPER.replace(**{INPUT: input, OUTPUT: output}))


def test_no_command_is_missing_at_a_machine(clock):
    """The timeout of a port that is given again begins with its first command."""
    changed = twin("torque", "torque")
    message = JointState(name=[SUN, RING], effort=[63.0, 147.0])
    commands = received(message, timeout=0.5, silence="zero")
    commands.given(changed, 0.01)
    changed.set(**{OUTPUT: "machine"})
    commands.given(changed, 0.01)
    clock[0] = 0.6
    assert commands.given(changed, 0.01) == {"input_torque": 0.0}
    changed.set(**{OUTPUT: "torque"})
    assert commands.given(changed, 0.01) == {"input_torque": 0.0}


def test_a_brake_begins_again_from_new_ports(clock):
    changed = twin("torque", "torque")
    commands = received(
        JointState(name=[SUN, RING], effort=[63.0, 147.0]), timeout=0.5, silence="brake"
    )
    commands.given(changed, 0.01)
    clock[0] = 0.6
    changed.advance(0.01, **commands.given(changed, 0.01))
    assert changed.ports == ("brake", "torque")
    commands.release(changed)
    changed.set(**{OUTPUT: "machine"})
    assert changed.ports == ("torque", "machine")
    assert commands.given(changed, 0.01) == {}
    assert changed.ports == ("brake", "machine")
    commands.receive(JointState(name=[SUN], effort=[20.0]))
    assert commands.given(changed, 0.01) == {"input_torque": 20.0}
    assert changed.ports == ("torque", "machine")


def test_efforts_are_those_of_the_present_ports():
    """Of a machine or a given torque, the torque on its rotor; of a motion, that of the shaft."""
    by_window, by_steps = twin(), twin()
    for each in (by_window, by_steps):
        each.advance(0.1)
        each.set(**{INPUT: "torque", OUTPUT: "motion"})
    window = by_window.advance(0.01, input_torque=50.0)
    sun, ring = (window.shaft_torque[window.bodies.index(name)] for name in ("sun", "ring"))
    assert sun == pytest.approx(50.0, rel=1e-12)
    shaft = [by_steps.step(1e-5, input_torque=50.0).output_torque for _ in range(1000)]
    assert ring == pytest.approx(np.mean(shaft), rel=1e-3)
    by_window.set(**{INPUT: "machine", OUTPUT: "machine"})
    load = by_window.advance(0.01).shaft_torque[window.bodies.index("ring")]
    assert load == pytest.approx(147.0, rel=0.03)
