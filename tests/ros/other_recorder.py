"""Another recorder with the QoS of rosbag2; prints the message counts by topic on SIGTERM.

The subscriptions are those of rosbag2 on Jazzy (`Rosbag2QoS`): reliable, with a depth of 10.
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from functools import partial

import rclpy
from planetary_twin_msgs.msg import GearboxState, MeshWaveform
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState

NAME = "rosbag2_recorder"
NAMESPACE = "/planetary_twin"
TOPICS = {"gearbox_state": GearboxState, "mesh_waveform": MeshWaveform, "joint_states": JointState}


def main() -> None:
    rclpy.init()
    node = rclpy.create_node(NAME, namespace=NAMESPACE)
    received: Counter[str] = Counter()

    def receive(topic: str, raw: bytes) -> None:
        received[f"{NAMESPACE}/{topic}"] += 1

    for topic, kind in TOPICS.items():
        node.create_subscription(
            kind, topic, partial(receive, topic), QoSProfile(depth=10), raw=True
        )
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        executor.spin()
    except (ExternalShutdownException, KeyboardInterrupt):
        print(json.dumps(received), flush=True)


if __name__ == "__main__":
    sys.exit(main())
