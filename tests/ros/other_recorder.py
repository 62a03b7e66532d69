"""Another recorder with the QoS of rosbag2; publishes the message counts by topic.

The subscriptions are those of rosbag2 on Jazzy (`Rosbag2QoS`): reliable, with a depth of 10.
"""

from __future__ import annotations

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

NAME = "rosbag2_recorder"
NAMESPACE = "/planetary_twin"
COUNTS = f"{NAMESPACE}/{NAME}/counts"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
TOPICS = {"gearbox_state": GearboxState, "mesh_waveform": MeshWaveform, "joint_states": JointState}


def main() -> None:
    rclpy.init()
    node = rclpy.create_node(NAME, namespace=NAMESPACE)
    received: Counter[str] = Counter()
    counts = node.create_publisher(String, COUNTS, LATCHED)

    def receive(topic: str, raw: bytes) -> None:
        received[f"{NAMESPACE}/{topic}"] += 1
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
