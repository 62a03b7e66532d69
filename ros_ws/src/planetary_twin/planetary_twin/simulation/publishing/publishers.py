"""The publishers of the twin: one publisher, one message and one count per topic."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs import msg
from rclpy.lifecycle import LifecyclePublisher
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from planetary_twin_py import Twin, Window
from planetary_twin_py.recording.ros2.axes_fields import axes_state_fields, axes_waveform_fields
from planetary_twin_py.recording.ros2.fields import waveform_fields
from planetary_twin_py.recording.ros2.given import joint_names
from planetary_twin_py.recording.ros2.topics import (
    AXES_STATE,
    AXES_WAVEFORM,
    DAMAGE,
    DAMAGE_TEETH,
    GIVEN,
)
from planetary_twin_py.recording.runs.origin import Origin, makers_here
from planetary_twin_py.robot import frames
from planetary_twin_py.run.twin import Change

from ...base.clock import StrictClock, set_stamp
from ...base.damage import KEPT, NEWEST
from ...base.lifecycle_node import ManagedNode
from ..damage import SimulatedDamage
from ..parameters import SimulationParameters, SimulationSettings
from .messages import (
    ClockMessage,
    DamageMessage,
    GivenMessage,
    IntervalMessage,
    JointsMessage,
    OperatingPointMessage,
    StateMessage,
    WaveMessage,
)
from .sensors import SensorOutlets
from .stamps import Stamps
from .transforms import TransformsMessage

_WAIT = 30  # [s] of wall time: longest wait for a recorder, with a margin
STALL = 10.0
"""Simulated time [s] for which a reliable subscriber may stall without losing a message."""


class Telemetry:
    """
    Publishes intervals, operating points and diagnostics on `node`, stamped with their ROS time.

    `given` are the parameters. `before` is the telemetry of the previous configuration, whose
    sequence numbers and stamps are continued. `damage` is that of the gearbox, if it is counted.
    """

    def __init__(
        self,
        node: ManagedNode,
        given: SimulationParameters,
        before: Telemetry | None,
        damage: SimulatedDamage | None = None,
    ) -> None:
        self._node, self._damage = node, damage
        settings = given.settings
        self._kept = round(STALL * settings.publish_rate)
        self._published: Counter[str] = Counter(before._published if before else {})  # by topic
        self._streams: dict[LifecyclePublisher, Any] = {}  # messages about intervals
        self._open_streams(given)
        # Late subscribers receive these, too, in order.
        latched = QoSProfile(depth=self._kept, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        newest = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._point = node.outlet(msg.OperatingPoint, "operating_point", latched)
        self._description = node.outlet(String, "robot_description", newest)
        self._origin_of_run = node.outlet(String, "run_origin", latched)
        self._diagnostics = node.outlet(DiagnosticArray, "/diagnostics", _reports_kept(settings))
        self._point_message = OperatingPointMessage(settings.frame_prefix + settings.frame_id)
        self._point_message.message.sequence = self._published[self._point.topic_name]
        self._topics = [
            publisher.topic_name
            for publisher in (
                *self._streams, *self._sensors.publishers, self._point, self._description,
                self._origin_of_run, self._diagnostics,
            )
        ]  # fmt: skip
        self._prepared: list[tuple[LifecyclePublisher, Any, float]] = []
        self._end = 0.0
        stamped = before.stamps.newest if before else 0
        self.stamps: Stamps = Stamps(node.get_clock(), settings.clock, stamped, settings.max_lag)
        """ROS times of simulated instants."""
        self._now: StrictClock = before._now if before else StrictClock(node.get_clock())

    def _open_streams(self, given: SimulationParameters) -> None:
        """
        Create the publishers of messages about an interval.

        They send in the order of the topics' names, in which recorders take messages, so that a
        recorder that keeps up writes them in the order of reception. The clock is first: no
        message may be stamped later.
        """
        scene, settings = given.scene, given.settings
        frame = settings.frame_prefix + settings.frame_id

        def stream(
            kind: type, topic: str, message: Any, qos: QoSProfile | int = self._kept
        ) -> LifecyclePublisher:
            publisher = self._node.outlet(kind, topic, qos)
            self._streams[publisher] = message
            if hasattr(message.message, "sequence"):
                message.message.sequence = self._published[publisher.topic_name]
            return publisher

        if settings.clock:
            stream(Clock, "/clock", ClockMessage())
        self._given: LifecyclePublisher | None = None
        if not scene.quasi_static:  # ports may be given later
            self._given = stream(JointState, GIVEN, GivenMessage(joint_names(scene)))
        if scene.moving_axes:
            axes = IntervalMessage(msg.AxesState, frame, axes_state_fields)
            waves = WaveMessage(msg.AxesWaveform, frame, axes_waveform_fields)
            stream(msg.AxesState, AXES_STATE, axes)
            stream(msg.AxesWaveform, AXES_WAVEFORM, waves)
        self._aging: set[LifecyclePublisher] = set()
        if self._damage is not None:
            for kind, topic, qos in (
                (msg.DamageState, DAMAGE, NEWEST), (msg.DamageTeeth, DAMAGE_TEETH, KEPT),
            ):  # fmt: skip
                aged = DamageMessage(kind, frame, self._damage, topic)
                self._aging.add(stream(kind, topic, aged, qos))
        stream(msg.GearboxState, "gearbox_state", StateMessage(scene, frame))
        stream(JointState, "joint_states", JointsMessage(settings.continuous_joints))
        wave = WaveMessage(msg.MeshWaveform, frame, waveform_fields)
        stream(msg.MeshWaveform, "mesh_waveform", wave)
        self._sensors = SensorOutlets(self._node, given, self._kept, self._published)
        self._transforms: LifecyclePublisher | None = None
        if settings.tf:
            bodies = frames(scene.gearset, settings.frame_id, scene.sensors)
            message = TransformsMessage(bodies, settings.frame_prefix)
            self._transforms = stream(TFMessage, "/tf", message)

    def describe(self, urdf: str) -> None:
        """Publish the robot description."""
        self._send(self._description, String(data=urdf))

    def has_clock(self) -> bool:
        """Return whether ROS time is available."""
        return self.stamps.ready()

    def resume(self, twin: Twin) -> None:
        """
        Map the present time of `twin` to the present ROS time, after a start or a halt.

        At time zero, publish the origin of the run that starts now: its scene and software.
        """
        self.stamps.begin(twin.time)
        if twin.time == 0.0:
            damage = None if self._damage is None else self._damage.begin()
            if damage is not None:
                twin.continue_cycles(damage.turning)
            origin = Origin(twin.start, self.stamp(0.0), makers_here(), damage)
            self._send(self._origin_of_run, String(data=origin.text()))

    @property
    def thermal(self) -> Mapping[str, Any] | None:
        """Return the fields of the last message ThermalState; None if there is none."""
        return self._sensors.thermal

    def stamp(self, simulated: float) -> int:
        """Return the ROS time [ns] of the instant `simulated` [s] in the newest interval."""
        return self.stamps.of(simulated)

    def streamed(self) -> dict[LifecyclePublisher, int]:
        """Return the number of messages by publisher, for topics with one message per interval."""
        return {
            publisher: self._published[publisher.topic_name]
            for publisher in self._streams
            if publisher is not self._given and publisher not in self._aging
        }

    def prepare(self, window: Window) -> None:
        """Fill the messages that describe `window`."""
        self._end = window.end
        if self._damage is not None:
            self._damage.add(window)
        filled = [
            (publisher, message, instant)
            for publisher, message in self._streams.items()
            if (instant := message.fill(window)) is not None
        ]
        place = len(filled) - (self._transforms is not None)  # before /tf, see `_open_streams`
        filled[place:place] = self._sensors.prepared(window)
        self._prepared = filled

    def publish(self) -> bool:
        """
        Stamp and publish the prepared messages; the interval ends at the present wall time.

        Returns whether their stamps have skipped a lag.
        """
        skipped = self.stamps.reach(self._end)
        for publisher, filled, instant in self._prepared:
            stamp = self.stamp(instant)
            for time in filled.stamps:
                set_stamp(time, stamp)
            self._send(publisher, filled.message)
        return skipped

    def announce(self, change: Change) -> None:
        """Publish operating point and ports after `change`."""
        message = self._point_message.fill(change)
        set_stamp(message.header.stamp, self.stamp(change.time))
        self._send(self._point, message)

    def diagnose(self, report: Callable[[Mapping[str, int]], DiagnosticArray]) -> None:
        """Stamp and publish the `report` on the message counts, which include this message."""
        counts = {topic: self._published[topic] for topic in self._topics}
        counts[self._diagnostics.topic_name] += 1
        message = report(counts)
        set_stamp(message.header.stamp, self._now.now())
        self._send(self._diagnostics, message)

    def _send(self, publisher: LifecyclePublisher, message: Any) -> None:
        publisher.publish(message)
        self._published[publisher.topic_name] += 1


def _reports_kept(settings: SimulationSettings) -> int:
    """Return the depth of /diagnostics, one per second of wall time, also while the twin waits."""
    slowest = min(settings.rate_factor or 1.0, 1.0)
    return math.ceil(STALL / slowest) + _WAIT
