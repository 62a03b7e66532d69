"""Stands in for ros2_control: `topic_system URDF TARGET`, as a process of its own.

It speaks the topics of `JointStateTopicSystem` 1.1.0 as its source does
(github.com/ros-controls/topic_based_hardware_interfaces), with topics, joints and interfaces from
the URDF, and has the controller of docs/examples/geared_joint_controllers.yaml.
"""

import math
import sys
from contextlib import suppress
from pathlib import Path
from xml.etree import ElementTree

import rclpy
import yaml
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import JointState

FIELDS = ("position", "velocity", "effort")


class TopicSystem(Node):
    """Reads joint states, updates the controller and writes commands in every cycle."""

    def __init__(self, urdf: Path, target: float) -> None:
        super().__init__("topic_system")
        hardware = ElementTree.parse(urdf).getroot().find("ros2_control")
        assert hardware is not None
        param = {each.get("name"): each.text for each in hardware.iter("param")}
        self._threshold = float(param["trigger_joint_command_threshold"] or "1e-5")
        self._commands = {
            str(joint.get("name")): [
                str(each.get("name")) for each in joint.findall("command_interface")
            ]
            for joint in hardware.findall("joint")
        }
        self._state = {f"{joint}/{field}": math.nan for joint in self._commands for field in FIELDS}
        self._publisher = self.create_publisher(
            JointState, str(param["joint_commands_topic"]), QoSProfile(depth=1)
        )
        self.create_subscription(
            JointState, str(param["joint_states_topic"]), self._read, qos_profile_sensor_data
        )
        text = urdf.with_name("geared_joint_controllers.yaml").read_text()
        parameters = {name: each["ros__parameters"] for name, each in yaml.safe_load(text).items()}
        self._controller, self._target = parameters["arm_controller"], target
        rate = parameters["controller_manager"]["update_rate"]
        self.create_timer(1.0 / rate, self._cycle)

    def _read(self, message: JointState) -> None:
        for place, name in enumerate(message.name):
            for field in FIELDS:
                values = getattr(message, field)
                if name in self._commands and values and math.isfinite(values[place]):
                    self._state[f"{name}/{field}"] = values[place]

    def _torque(self) -> float:
        """The command of the PID controller; NaN until there is a state."""
        (motor,), (arm,) = (
            self._controller[name] for name in ("dof_names", "reference_and_state_dof_names")
        )
        gains = self._controller["gains"][motor]
        position, velocity = self._state[f"{arm}/position"], self._state[f"{arm}/velocity"]
        return float(gains["p"] * (self._target - position) - gains["d"] * velocity)

    def _cycle(self) -> None:
        torque, difference = self._torque(), 0.0
        message = JointState()
        for joint, interfaces in self._commands.items():
            message.name.append(joint)
            message.header.stamp = self.get_clock().now().to_msg()
            for interface in interfaces:
                difference += abs(self._state[f"{joint}/{interface}"] - torque)
                getattr(message, interface).append(torque)
        if not difference <= self._threshold:
            self._publisher.publish(message)


if __name__ == "__main__":
    rclpy.init()
    with suppress(ExternalShutdownException):  # the test ends it by a signal
        rclpy.spin(TopicSystem(Path(sys.argv[1]), float(sys.argv[2])))
