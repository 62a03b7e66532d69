"""Executors end at a signal, whether ROS is shut down before or after they wake."""

import subprocess
import sys

PROGRAM = """
import os, signal, threading, time
import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions
from planetary_twin.base.spin import wake_after_shutdown
from planetary_twin.process.signals import SIGNALS

def as_rclpy_does(executor):
    time.sleep(0.2)
    os.kill(os.getpid(), signal.SIGTERM)
    executor.wake()
    time.sleep(0.2)  # in which it goes back to waiting
    rclpy.get_default_context().handle.shutdown()

SIGNALS.install()
rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
executor = SingleThreadedExecutor()
threading.Thread(target=as_rclpy_does, args=[executor]).start()
threading.Thread(target=wake_after_shutdown, args=[[executor]]).start()
try:
    executor.spin()
except ExternalShutdownException:
    pass
print("ended")
"""


def test_an_executor_that_wakes_before_ros_is_shut_down_ends_too(domain: int) -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], capture_output=True, text=True, timeout=30, check=True
    )
    assert done.stdout == "ended\n"
