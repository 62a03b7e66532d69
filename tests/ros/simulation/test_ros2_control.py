"""The twin behind ros2_control's JointStateTopicSystem: its topics, names, fields and rates.

The packages of ros2_control are not to be had from a package index, so a process stands in that
speaks the same topics over DDS, see topic_system.py.
"""

import math
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin.simulation.diagnostics.commands import COMMANDS
from sensor_msgs.msg import JointState

from ..peer import TWIN
from ..reported import statuses

EXAMPLES = Path(__file__).parents[3] / "docs" / "examples"
TARGET = 0.5  # [rad]


@pytest.fixture
def topic_system(domain: int) -> Iterator[subprocess.Popen[bytes]]:
    """The process that stands in; it ends with the test."""
    script, urdf = Path(__file__).with_name("topic_system.py"), EXAMPLES / "geared_joint.urdf"
    process = subprocess.Popen([sys.executable, str(script), str(urdf), str(TARGET)])
    yield process
    process.terminate()
    process.wait(60.0)


def test_a_controller_of_ros2_control_moves_the_arm(peer, start, topic_system):
    """A tenth of real time leaves a busy machine time for the loop over both topics."""
    scene = EXAMPLES / "geared_joint.yaml"
    given = {"publish_rate": 200.0, "continuous_joints": "true", "rate_factor": 0.1}
    start("planetary_twin.simulation", scene=scene, **given)
    commands = peer.listen(JointState, f"{TWIN}/simulation/command")
    states = peer.listen(JointState, f"{TWIN}/joint_states")
    diagnostics = peer.listen(DiagnosticArray, "/diagnostics")

    def arm() -> tuple[float, float]:
        place = list(states[-1].name).index("carrier_joint")
        return states[-1].position[place], states[-1].velocity[place]

    def rests_at_target() -> bool:
        angle, speed = arm() if states else (math.inf, math.inf)
        return abs(angle - TARGET) < 0.1 and abs(speed) < 0.05

    peer.until(lambda: len(states) > 10)
    peer.until(rests_at_target)
    given = [each for each in commands if not math.isnan(each.effort[0])]
    assert {tuple(each.name) for each in commands} == {("sun_joint", "carrier_joint")}
    assert {(len(e.position), len(e.velocity), len(e.effort)) for e in commands} == {(0, 0, 1)}
    # At rest the controller gives what is left of the error times its gain, and the motor has that
    # torque on its shaft.
    angle, _ = arm()
    assert given[-1].effort[0] == pytest.approx(0.1 * (TARGET - angle), abs=0.02 * 0.05 + 1e-4)
    # The twin may answer a command before this process has read the command itself.
    torque = states[-1].effort[list(states[-1].name).index("sun_joint")]
    peer.until(lambda: any(abs(each.effort[0] - torque) < 1e-6 for each in commands))
    assert topic_system.poll() is None
    values = peer.until(lambda: statuses(diagnostics, COMMANDS))[-1].values
    # Before the controller has a state, its commands are NaN.
    assert {each.key for each in values if each.key.startswith("ignored")} <= {
        "ignored: no effort, velocity or position of sun_joint or carrier_joint"
    }
