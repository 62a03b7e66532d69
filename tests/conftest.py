"""For all tests: real DDS, on a domain of this run's own and on this machine alone; Ctrl-C."""

import os
import signal
from pathlib import Path

ROOT = Path(__file__).parents[1]

# A shell has what it runs in the background ignore Ctrl-C, and so does all that starts from there.
signal.signal(signal.SIGINT, signal.default_int_handler)

# Read when rclpy and the message classes are first imported; child processes inherit them.
os.environ["ROS_DOMAIN_ID"] = str(1 + os.getpid() % 100)
# As `planetary-twin run` has it: nodes find one another at once, and none stumbles over what
# another that was killed has left in shared memory.
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "SYSTEM_DEFAULT"
profile = ROOT / "ros_ws/src/planetary_twin/config/loopback.xml"
os.environ["FASTRTPS_DEFAULT_PROFILES_FILE"] = str(profile)
os.environ["ROS_PYTHON_CHECK_FIELDS"] = "1"
