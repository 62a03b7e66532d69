"""Joint positions that count whole turns follow the speed, and their recording verifies."""

import math

import numpy as np
import pytest
from planetary_twin.simulation.publishing.messages import JointsMessage
from planetary_twin_msgs.msg import GearboxState
from sensor_msgs.msg import JointState

import planetary_twin_py as pt
from planetary_twin_py.recording.runs.verify import verify

from ...peer import LONG, TWIN

TURN = 2.0 * math.pi


def position_after(joints: JointsMessage, window: pt.Window) -> np.ndarray:
    joints.fill(window)
    return np.array(joints.message.position)


def positions(count: int, continuous: bool) -> tuple[np.ndarray, np.ndarray]:
    """Joint positions of a twin after each of `count` windows of 10 ms, and its mean speeds."""
    twin = pt.Twin(pt.load_scene("paper").replace(dynamics="quasi_static"))
    joints, found, speeds = JointsMessage(continuous), [], []
    for _ in range(count):
        window = twin.advance(0.01)
        found.append(position_after(joints, window))
        speeds.append(window.mean_speed)
    return np.array(found), np.array(speeds)


def test_continuous_positions_are_the_integral_of_the_speed():
    wrapped, speeds = positions(100, continuous=False)
    counted, _ = positions(100, continuous=True)
    assert wrapped.min() >= 0.0 and wrapped.max() <= TURN
    integral = counted[0] + np.vstack((np.zeros_like(counted[0]), np.cumsum(speeds[1:], 0) * 0.01))
    assert np.allclose(counted, integral, rtol=0.0, atol=1e-9)
    assert np.abs(counted - counted[0]).max() > 10.0 * TURN
    apart = np.mod(counted - wrapped + math.pi, TURN) - math.pi
    assert np.abs(apart).max() < 1e-9


def test_a_window_after_a_gap_starts_a_new_count():
    scene = pt.load_scene("paper").replace(dynamics="quasi_static")
    first, second = pt.Twin(scene), pt.Twin(scene)
    joints = JointsMessage(True)
    first.advance(0.1)  # a gap: this window is not published
    for twin in (first, second):  # a reset starts another twin
        window = twin.advance(0.1)
        begin = position_after(joints, window) - 0.1 * window.mean_speed
        assert np.abs(begin).max() <= 0.5 * TURN


def test_a_joint_may_start_below_zero():
    ports = {"drive.input.port": "torque", "drive.output.port": "torque"}
    twin = pt.Twin(pt.load_scene("paper").replace(input_torque=1.0, **ports))
    window = twin.advance(1e-3, input_torque=0.0, output_torque=0.0)
    place = window.bodies.index("ring")
    assert window.angle[place] > math.pi  # the output turns against the input
    counted = position_after(JointsMessage(True), window)
    assert counted[place] == pytest.approx(twin.port_states.output_angle, abs=0.01)
    assert -0.1 < counted[place] < 0.0


def test_a_node_publishes_them_on_request_and_is_verified(peer, start, tmp_path):
    logger = start("planetary_twin.logger", name="bag")
    twin = start("planetary_twin.simulation", continuous_joints="true", wait_for="logger")
    joints = peer.listen(JointState, f"{TWIN}/joint_states")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    peer.until(lambda: len(joints) > 60 and len(states) > 60)
    sun = [joint.position[joint.name.index("sun_joint")] for joint in joints]
    assert sun[-1] - sun[0] > 3.0 * TURN and min(np.diff(sun)) > 0.0
    for process in (twin, logger):
        process.terminate()
        assert process.wait(LONG) == 0
    verdict = verify(tmp_path / "recordings/bag", TWIN)
    assert verdict.identical, verdict
    assert verdict.messages["joint_states"] > 60
