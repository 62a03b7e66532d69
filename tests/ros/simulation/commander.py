"""A client that commands one joint until it is killed: `commander JOINT FIELD VALUE RATE`."""

import itertools
import sys
import time

import rclpy
from sensor_msgs.msg import JointState

TOPIC = "/planetary_twin/simulation/command"


def main(joint: str, field: str, value: float, rate: float) -> None:
    """Publish stamped commands at `rate` [Hz], or as many as it can."""
    rclpy.init()
    node = rclpy.create_node(f"commander_of_{joint}")
    publisher = node.create_publisher(JointState, TOPIC, 10)
    while not publisher.get_subscription_count():
        time.sleep(0.01)
    message = JointState(name=[joint], **{field: [value]})
    begin = time.monotonic()
    for number in itertools.count(1):
        message.header.stamp = node.get_clock().now().to_msg()
        publisher.publish(message)
        if number == 1:
            print("commanding", flush=True)
        time.sleep(max(begin + number / rate - time.monotonic(), 0.0))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], float(sys.argv[3]), float(sys.argv[4]))
