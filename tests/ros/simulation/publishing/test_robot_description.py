"""The simulation publishes what robot_state_publisher and RViz need to draw it."""

from __future__ import annotations

import cmath
from typing import NamedTuple
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from planetary_twin_msgs.msg import GearboxState
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from ...peer import TWIN

PREFIX = "left/"
BODIES = ("sun", "planet_1", "planet_2", "planet_3", "ring", "carrier")
# As `ros2 topic info -v /tf` prints it in Jazzy: the type built here must equal that of ROS.
HASH_OF_TF = "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Pose(NamedTuple):
    """Pose of a frame in the plane: position x + iy [m], and rotation as a unit complex number."""

    at: complex
    turn: complex

    def of(self, child: Pose) -> Pose:
        return Pose(self.at + self.turn * child.at, self.turn * child.turn)


def poses_by_urdf(robot: Element, state: JointState) -> dict[tuple[str, str], Pose]:
    """Forward kinematics as robot_state_publisher does it: each frame in its parent."""
    position = dict(zip(state.name, state.position, strict=True))
    poses = {}
    for joint in robot.findall("joint"):
        mimic, origin = joint.find("mimic"), joint.find("origin")
        assert joint.find("axis").attrib["xyz"] == "0 0 1"
        angle = (
            position[joint.attrib["name"]]
            if mimic is None
            else position[mimic.attrib["joint"]] * float(mimic.attrib["multiplier"])
        )
        x, y, _ = map(float, origin.attrib["xyz"].split())
        *_, yaw = map(float, origin.attrib["rpy"].split())
        parent, child = (joint.find(end).attrib["link"] for end in ("parent", "child"))
        poses[parent, child] = Pose(complex(x, y), cmath.exp(1j * (yaw + angle)))
    return poses


def poses_by_tf(message: TFMessage) -> dict[tuple[str, str], Pose]:
    poses = {}
    for stamped in message.transforms:
        place, turn = stamped.transform.translation, stamped.transform.rotation
        assert (place.z, turn.x, turn.y) == (0.0, 0.0, 0.0)
        ends = stamped.header.frame_id, stamped.child_frame_id
        assert all(end.startswith(PREFIX) for end in ends)
        parent, child = (end.removeprefix(PREFIX) for end in ends)
        poses[parent, child] = Pose(complex(place.x, place.y), complex(turn.w, turn.z) ** 2)
    return poses


def in_base(poses: dict[tuple[str, str], Pose], frame: str) -> Pose:
    """Pose of `frame` in the root of the tree."""
    for (parent, child), pose in poses.items():
        if child == frame:
            return in_base(poses, parent).of(pose)
    return Pose(0.0, 1.0)


def test_frames_of_the_description_follow_the_joints(peer, start):
    start("planetary_twin.simulation", frame_id="gearbox_base", frame_prefix=PREFIX)
    states = peer.listen(JointState, f"{TWIN}/joint_states")
    transforms = peer.listen(TFMessage, "/tf")
    gearbox = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    peer.until(lambda: len(states) > 100 and transforms and gearbox)
    received = peer.listen(String, f"{TWIN}/robot_description", LATCHED)
    robot = ElementTree.fromstring(peer.until(lambda: received)[0].data)
    joints = {joint.attrib["name"] for joint in robot.iter("joint") if "name" in joint.attrib} - {
        joint.attrib["name"] for joint in robot.iter("joint") if joint.find("mimic") is not None
    }
    assert joints == set(states[0].name)
    children = {joint.attrib["link"] for joint in robot.iter("child")}
    links = {link.attrib["name"] for link in robot.iter("link")}
    assert links - children == {"gearbox_base"}
    assert gearbox[0].header.frame_id == PREFIX + "gearbox_base"
    shown = {link.attrib["name"] for link in robot.iter("link") if link.find("visual") is not None}
    assert shown == set(BODIES)

    (publisher,) = peer.node.get_publishers_info_by_topic("/tf")
    assert str(publisher.topic_type_hash) == HASH_OF_TF
    stamped = {str(state.header.stamp): state for state in states}
    matching = [tf for tf in transforms if str(tf.transforms[0].header.stamp) in stamped]
    assert len(matching) > 90
    for message in matching:
        (stamp,) = {str(transform.header.stamp) for transform in message.transforms}
        by_urdf, by_tf = poses_by_urdf(robot, stamped[stamp]), poses_by_tf(message)
        assert by_urdf.keys() == by_tf.keys()
        for link in links:
            wanted, found = in_base(by_urdf, link), in_base(by_tf, link)
            assert abs(found.at - wanted.at) < 1e-9 and abs(found.turn - wanted.turn) < 1e-9
    angles = [state.position[list(state.name).index("sun_joint")] for state in states]
    assert max(angles) - min(angles) > 1.0  # it has turned in the meantime
