"""What the simulation publishes is what robot_state_publisher and RViz need to draw it."""

from __future__ import annotations

from pathlib import Path
from urllib.parse import unquote, urlparse
from xml.etree import ElementTree

import pytest
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String

from .conftest import Start
from .peer import TWIN, Peer

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def test_a_late_subscriber_gets_the_gearbox_with_the_joints_that_move(
    peer: Peer, start: Start
) -> None:
    start("planetary_twin.simulation", "--ros-args", "-p", "frame_id:=left_gearbox")
    states = peer.listen(JointState, f"{TWIN}/joint_states")
    peer.until(lambda: states, 120.0)
    heard = peer.listen(String, f"{TWIN}/robot_description", LATCHED)
    robot = ElementTree.fromstring(peer.until(lambda: heard)[0].data)
    joints = {joint.attrib["name"] for joint in robot.iter("joint") if "name" in joint.attrib} - {
        joint.attrib["name"] for joint in robot.iter("joint") if joint.find("mimic") is not None
    }
    assert joints == set(states[0].name)
    children = {joint.attrib["link"] for joint in robot.iter("child")}
    links = {link.attrib["name"] for link in robot.iter("link")}
    assert links - children == {"left_gearbox"}
    for mesh in robot.iter("mesh"):
        assert Path(unquote(urlparse(mesh.attrib["filename"]).path)).is_file()


def test_a_cache_folder_that_cannot_be_written_ends_in_one_line(
    start: Start, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("in the way")
    # The compiled model has a cache of its own: only the meshes are under test.
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "kernels"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    process = start("planetary_twin.simulation")
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 1
    assert len(errors.strip().splitlines()) == 1
    assert "XDG_CACHE_HOME" in errors
