"""Types of the messages of a measured gearbox."""

from ...recording.ros2.sensor_topics import ENCODERS, TEMPERATURE
from ...recording.ros2.sensor_topics import SAMPLED as VIBRATION

__all__ = ["ENCODERS", "JOINTS", "TEMPERATURE", "VIBRATION"]

JOINTS = ("sensor_msgs/msg/JointState", "control_msgs/msg/DynamicJointState")
