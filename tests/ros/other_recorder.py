"""Another recorder with the QoS of rosbag2; publishes the message counts by topic.

Like rosbag2 on Jazzy, it runs outside the namespace of the twin, and its subscriptions are reliable
with a depth of 10 (`Rosbag2QoS`).
"""

import contextlib
import json
import sys
from collections import Counter
from functools import partial

import rclpy
from planetary_twin_msgs.msg import GearboxState, MeshWaveform
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String

NAME = "/rosbag2_recorder"
COUNTS = f"{NAME}/counts"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
KINDS = {"gearbox_state": GearboxState, "mesh_waveform": MeshWaveform, "joint_states": JointState}
TOPICS = {f"/planetary_twin/{name}": kind for name, kind in KINDS.items()}


def main() -> None:
    rclpy.init()
    node = rclpy.create_node(NAME.removeprefix("/"))
    received: Counter[str] = Counter()
    counts = node.create_publisher(String, COUNTS, LATCHED)

    def receive(topic: str, raw: bytes) -> None:
        received[topic] += 1
        counts.publish(String(data=json.dumps(received)))

    for topic, kind in TOPICS.items():
        node.create_subscription(
            kind, topic, partial(receive, topic), QoSProfile(depth=10), raw=True
        )
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    with contextlib.suppress(ExternalShutdownException, KeyboardInterrupt):
        executor.spin()


if __name__ == "__main__":
    sys.exit(main())
