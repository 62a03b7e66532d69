"""Publishes numbered messages: `counter TOPIC RATE COUNT SIZE DEPTH RELIABILITY`.

Waits for a subscriber, sends COUNT numbered strings of SIZE bytes at RATE per second (0: as fast as
possible), and one more after a line on standard input, when the others have been handled.
"""

import sys
import time

import rclpy
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String


def main(topic: str, rate: float, count: int, size: int, qos: QoSProfile) -> None:
    rclpy.init()
    publisher = rclpy.create_node("counter").create_publisher(String, topic, qos)
    print("ready", flush=True)
    while publisher.get_subscription_count() == 0:
        time.sleep(0.01)
    begin = time.monotonic()
    for number in range(1, count + 1):
        publisher.publish(String(data=f"{number} ".ljust(size, "x")))
        if rate:
            time.sleep(max(begin + number / rate - time.monotonic(), 0.0))
    print("sent", flush=True)
    sys.stdin.readline()
    publisher.publish(String(data=f"{count + 1} "))
    print("last", flush=True)
    sys.stdin.readline()


if __name__ == "__main__":
    reliability = ReliabilityPolicy[sys.argv[6]]
    main(
        sys.argv[1],
        float(sys.argv[2]),
        int(sys.argv[3]),
        int(sys.argv[4]),
        QoSProfile(depth=int(sys.argv[5]), reliability=reliability),
    )
