"""Executors end at a signal, whether ROS is shut down before or after they wake."""

import subprocess
import sys

PROGRAM = """
import threading, time
import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from planetary_twin.base.lifecycle_node import ManagedNode

def as_rclpy_does(executor):
    time.sleep(0.2)
    executor.wake()
    time.sleep(0.2)  # in which it goes back to waiting
    rclpy.get_default_context().handle.shutdown()

rclpy.init()
executor = SingleThreadedExecutor()
executor.add_node(ManagedNode("idle"))
threading.Thread(target=as_rclpy_does, args=[executor]).start()
try:
    executor.spin()
except ExternalShutdownException:
    pass
print("ended")
"""


def test_an_executor_that_wakes_before_ros_is_shut_down_ends_too(domain):
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], capture_output=True, text=True, timeout=30, check=True
    )
    assert done.stdout == "ended\n"
