"""For all tests: real DDS, on a domain of this run's own and on this machine alone; Ctrl-C."""

import os
import signal

# A shell has what it runs in the background ignore Ctrl-C, and so does all that starts from there.
signal.signal(signal.SIGINT, signal.default_int_handler)

# Read when rclpy and the message classes are first imported; child processes inherit them.
os.environ["ROS_DOMAIN_ID"] = str(1 + os.getpid() % 100)
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
os.environ["ROS_PYTHON_CHECK_FIELDS"] = "1"
