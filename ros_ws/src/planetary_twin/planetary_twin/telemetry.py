"""What the twin publishes: one publisher, one message and one count per topic."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs import msg
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String

from planetary_twin_py import OperatingPoint, Scene, Window
from planetary_twin_py.recording.origin import Origin, makers_here

from .messages import JointsMessage, OperatingPointMessage, StateMessage, WaveformMessage

_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
# As `use_sim_time` listens.
_CLOCK = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
_DEPTH = 10


class Telemetry:
    """Publishes windows, operating points and diagnostics, stamped with their own ROS time."""

    def __init__(self, node: Node, scene: Scene, frame: str, clock: bool) -> None:
        self._state = node.create_publisher(msg.GearboxState, "gearbox_state", _DEPTH)
        self._waveform = node.create_publisher(msg.MeshWaveform, "mesh_waveform", _DEPTH)
        self._joints = node.create_publisher(JointState, "joint_states", _DEPTH)
        self._point = node.create_publisher(msg.OperatingPoint, "operating_point", _LATCHED)
        self._description = node.create_publisher(String, "robot_description", _LATCHED)
        self._origin_of_run = node.create_publisher(String, "run_origin", _LATCHED)
        self._diagnostics = node.create_publisher(DiagnosticArray, "/diagnostics", _DEPTH)
        self._clock = node.create_publisher(Clock, "/clock", _CLOCK) if clock else None
        self._state_message = StateMessage(scene, frame)
        self._waveform_message = WaveformMessage(scene, frame)
        self._joints_message: JointsMessage | None = None
        self._point_message = OperatingPointMessage(frame)
        self._prepared: list[tuple[Publisher, Any]] = []
        self._origin = 0
        self._newest = 0
        publishers = (
            self._state,
            self._waveform,
            self._joints,
            self._point,
            self._description,
            self._origin_of_run,
            self._diagnostics,
            self._clock,
        )
        self._published = {publisher: 0 for publisher in publishers if publisher is not None}

    def describe(self, urdf: str) -> None:
        """Publish what the gearbox looks like."""
        self._send(self._description, String(data=urdf))

    def originate(self, scene: Scene) -> None:
        """Publish what the run that begins now follows from."""
        origin = Origin(scene, self.stamp(0.0), makers_here())
        self._send(self._origin_of_run, String(data=origin.text()))

    def begin(self, now: int, simulated: float) -> None:
        """Let time `simulated` [s] be the ROS time `now` [ns], or later if stamps ran ahead."""
        self._origin = max(now, self._newest) - round(simulated * 1e9)

    def stamp(self, simulated: float) -> int:
        """ROS time [ns] of simulated time `simulated` [s]."""
        return self._origin + round(simulated * 1e9)

    def prepare(self, window: Window) -> None:
        """Fill the messages that describe `window`."""
        if self._joints_message is None:
            self._joints_message = JointsMessage(window.bodies)
        end = self._newest = self.stamp(window.end)
        self._prepared = [
            (self._state, self._state_message.fill(window, end)),
            (self._joints, self._joints_message.fill(window, end)),
        ]
        if len(window.waveform.time):  # a single step may be shorter than the sample period
            wave = self._waveform_message.fill(window, self._origin)
            self._prepared.append((self._waveform, wave))
        if self._clock is not None:
            self._prepared.append((self._clock, Clock(clock=Time(nanoseconds=end).to_msg())))

    def publish(self) -> None:
        """Send what is prepared."""
        for publisher, message in self._prepared:
            self._send(publisher, message)

    def announce(self, point: OperatingPoint, instant: float) -> None:
        """Publish the operating point in force from simulated time `instant` [s]."""
        self._send(self._point, self._point_message.fill(point, instant, self.stamp(instant)))

    def diagnose(self, report: Callable[[Mapping[str, int]], DiagnosticArray]) -> DiagnosticArray:
        """Publish what `report` makes of the message counts, its own message counted."""
        counts = dict(self._published)
        counts[self._diagnostics] += 1
        message = report({publisher.topic_name: n for publisher, n in counts.items()})
        self._send(self._diagnostics, message)
        return message

    def _send(self, publisher: Publisher, message: Any) -> None:
        publisher.publish(message)
        self._published[publisher] += 1
