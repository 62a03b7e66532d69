"""The publishers of the twin: one publisher, one message and one count per topic."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs import msg
from rclpy.lifecycle import LifecycleNode, LifecyclePublisher
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from planetary_twin_py import Scene, Window
from planetary_twin_py.recording.ros2.axes_fields import axes_state_fields, axes_waveform_fields
from planetary_twin_py.recording.ros2.fields import waveform_fields
from planetary_twin_py.recording.ros2.given import fields_of, joint_names
from planetary_twin_py.recording.ros2.topics import AXES_STATE, AXES_WAVEFORM, GIVEN
from planetary_twin_py.recording.runs.origin import Origin, makers_here
from planetary_twin_py.robot import frames
from planetary_twin_py.run.twin import Change

from ...base.clock import StrictClock, set_stamp
from ..parameters import SimulationParameters
from .messages import IntervalMessage, JointsMessage, OperatingPointMessage, StateMessage
from .stamps import Stamps
from .transforms import TransformsMessage

_WAIT = 30  # [s] of wall time: longest wait for a recorder, with a margin
_COUNTED = (
    "_state_message",
    "_waveform_message",
    "_point_message",
    "_axes_message",
    "_axes_waveform_message",
)
STALL = 10.0
"""Simulated time [s] for which a reliable subscriber may stall without losing a message."""


class Telemetry:
    """
    Publishes intervals, operating points and diagnostics on `node`, stamped with their ROS time.

    `given` are the parameters. `before` is the closed telemetry of the previous configuration,
    whose sequence numbers and stamps are continued.
    """

    def __init__(
        self, node: LifecycleNode, given: SimulationParameters, before: Telemetry | None
    ) -> None:
        self._node = node
        self._open(given)
        frame = given.frame_prefix + given.frame
        self._state_message = StateMessage(given.scene, frame)
        self._waveform_message = IntervalMessage(msg.MeshWaveform, frame, waveform_fields)
        self._axes_message = IntervalMessage(
            msg.AxesState, frame, lambda window: axes_state_fields(window, window.axes)
        )
        self._axes_waveform_message = IntervalMessage(
            msg.AxesWaveform, frame, lambda window: axes_waveform_fields(window, window.axes)
        )
        self._joints_message: JointsMessage | None = None
        self._continuous = given.continuous_joints
        self._point_message = OperatingPointMessage(frame)
        self._clock_message = Clock()
        self._transforms_message = TransformsMessage(
            frames(given.scene.gearset, given.frame), given.frame_prefix
        )
        self._prepared: list[tuple[LifecyclePublisher, Any, list[Time], float]] = []
        self._end = 0.0
        newest = before.stamps.newest if before else 0
        self.stamps = Stamps(node.get_clock(), given.clock, newest, given.max_lag)
        """ROS times of simulated instants."""
        self._now = before._now if before else StrictClock(node.get_clock())
        self._published = dict.fromkeys(self._topics, 0)
        if before is not None:
            self._continue(before)

    def _open(self, given: SimulationParameters) -> None:
        self._topics: dict[LifecyclePublisher, str] = {}
        self._streams: list[LifecyclePublisher] = []  # one message per interval
        kept = round(STALL * given.rate)

        def create(kind: type, topic: str, qos: QoSProfile | int) -> LifecyclePublisher:
            publisher = self._node.create_lifecycle_publisher(kind, topic, qos)
            self._topics[publisher] = publisher.topic_name
            return publisher

        def stream(kind: type, topic: str) -> LifecyclePublisher:
            self._streams.append(create(kind, topic, kept))
            return self._streams[-1]

        # Late subscribers receive these, too, in order.
        latched = QoSProfile(depth=kept, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        newest = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._state = stream(msg.GearboxState, "gearbox_state")
        self._waveform = stream(msg.MeshWaveform, "mesh_waveform")
        self._joints = stream(JointState, "joint_states")
        self._point = create(msg.OperatingPoint, "operating_point", latched)
        self._description = create(String, "robot_description", newest)
        self._origin_of_run = create(String, "run_origin", latched)
        self._diagnostics = create(DiagnosticArray, "/diagnostics", _reports_kept(given))
        self._tf = stream(TFMessage, "/tf") if given.tf else None
        self._clock = stream(Clock, "/clock") if given.clock else None
        drivable = not given.scene.quasi_static  # ports may be given later
        self._given = create(JointState, GIVEN, kept) if drivable else None
        moving = given.scene.moving_axes
        self._axes = stream(msg.AxesState, AXES_STATE) if moving else None
        self._axes_waveform = stream(msg.AxesWaveform, AXES_WAVEFORM) if moving else None
        self._shafts = joint_names(given.scene)

    def _continue(self, before: Telemetry) -> None:
        earlier = before._counts()
        self._published = {p: earlier.get(topic, 0) for p, topic in self._topics.items()}
        for name in _COUNTED:
            getattr(self, name).message.sequence = getattr(before, name).message.sequence

    def close(self) -> None:
        """Destroy the publishers."""
        for publisher in self._topics:
            self._node.destroy_lifecycle_publisher(publisher)

    def describe(self, urdf: str) -> None:
        """Publish the robot description."""
        self._send(self._description, String(data=urdf))

    def originate(self, scene: Scene) -> None:
        """Publish the origin of the run that starts now: its scene and software."""
        origin = Origin(scene, self.stamp(0.0), makers_here())
        self._send(self._origin_of_run, String(data=origin.text()))

    def ready(self) -> bool:
        """Return whether ROS time is available."""
        return self.stamps.ready()

    def begin(self, simulated: float) -> None:
        """Map time `simulated` [s] to the present ROS time."""
        self.stamps.begin(simulated)

    def stamp(self, simulated: float) -> int:
        """Return the ROS time [ns] of the instant `simulated` [s] in the newest interval."""
        return self.stamps.of(simulated)

    @property
    def newest(self) -> int:
        """Newest stamp [ns]."""
        return self.stamps.newest

    def streamed(self) -> dict[LifecyclePublisher, int]:
        """Return the number of messages by publisher, for topics with one message per interval."""
        return {stream: self._published[stream] for stream in self._streams}

    def prepare(self, window: Window) -> None:
        """
        Fill the messages that describe `window`.

        They are sent in the order of their topics' names, in which recorders take messages, so
        that a recorder that keeps up writes them in the order of reception.
        """
        if self._joints_message is None:
            self._joints_message = JointsMessage(window.bodies, self._continuous)
        self._end = window.end
        self._prepared.clear()
        if self._clock is not None:  # first: no message may be stamped later than the clock
            clock = self._clock_message
            self._prepared.append((self._clock, clock, [clock.clock], window.end))
        if self._given is not None and window.given:
            given = JointState(**fields_of(window.given, self._shafts))
            self._prepared.append((self._given, given, [given.header.stamp], window.end))
        self._prepare_axes(window)
        state, joints = self._state_message.fill(window), self._joints_message.fill(window)
        self._prepared.append((self._state, state, [state.header.stamp], window.end))
        self._prepared.append((self._joints, joints, [joints.header.stamp], window.end))
        if len(window.waveform.time):  # a single step may be shorter than the sample period
            wave = self._waveform_message.fill(window)
            self._prepared.append((self._waveform, wave, [wave.header.stamp], wave.start_time))
        if self._tf is not None:
            transforms = self._transforms_message
            self._prepared.append(
                (self._tf, transforms.fill(window), transforms.stamps, window.end)
            )

    def _prepare_axes(self, window: Window) -> None:
        """Fill the messages about axes that move."""
        if self._axes is None or window.axes is None:
            return
        state = self._axes_message.fill(window)
        self._prepared.append((self._axes, state, [state.header.stamp], window.end))
        if len(window.waveform.time):
            wave = self._axes_waveform_message.fill(window)
            self._prepared.append(
                (self._axes_waveform, wave, [wave.header.stamp], wave.start_time)
            )

    def publish(self) -> bool:
        """Stamp and publish the prepared messages; whether their stamps have skipped a lag."""
        skipped = self.stamps.reach(self._end)
        for publisher, message, times, instant in self._prepared:
            stamp = self.stamp(instant)
            for time in times:
                set_stamp(time, stamp)
            self._send(publisher, message)
        return skipped

    def announce(self, change: Change) -> None:
        """Publish operating point and ports after `change`."""
        message = self._point_message.fill(change)
        set_stamp(message.header.stamp, self.stamp(change.time))
        self._send(self._point, message)

    def diagnose(self, report: Callable[[Mapping[str, int]], DiagnosticArray]) -> DiagnosticArray:
        """Stamp and publish the `report` on the message counts, which include this message."""
        counts = self._counts()
        counts[self._topics[self._diagnostics]] += 1
        message = report(counts)
        set_stamp(message.header.stamp, self._now.now())
        self._send(self._diagnostics, message)
        return message

    def _counts(self) -> dict[str, int]:
        """Return the number of published messages by topic."""
        return {topic: self._published[publisher] for publisher, topic in self._topics.items()}

    def _send(self, publisher: LifecyclePublisher, message: Any) -> None:
        publisher.publish(message)
        self._published[publisher] += 1


def _reports_kept(given: SimulationParameters) -> int:
    """Return the depth of /diagnostics, one per second of wall time, also while the twin waits."""
    slowest = min(given.rate_factor or 1.0, 1.0)
    return math.ceil(STALL / slowest) + _WAIT
