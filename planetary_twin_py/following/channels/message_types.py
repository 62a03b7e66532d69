"""Types of the messages of a measured gearbox with one value of a sensor."""

from ...recording.ros2.sensor_topics import TEMPERATURE

__all__ = ["JOINTS", "TEMPERATURE"]

JOINTS = ("sensor_msgs/msg/JointState", "control_msgs/msg/DynamicJointState")
