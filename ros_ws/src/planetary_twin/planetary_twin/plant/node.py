"""The plant node: publishes simulated measurements of a gearbox with hidden changes."""

from __future__ import annotations

import itertools
import math
import traceback
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from planetary_twin_msgs.msg import EncoderBlock, SampledBlock
from rclpy.duration import Duration
from rclpy.lifecycle import LifecyclePublisher
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState, Temperature

import planetary_twin_py as pt
from planetary_twin_py.plant.hidden import Hidden, read_hidden
from planetary_twin_py.plant.readings import Plant as Played
from planetary_twin_py.plant.timeline import Measured, timeline

from ..base.clock import CLOCK_AWAITED, has_time
from ..base.lifecycle_node import ManagedNode, shut_down
from ..base.parameters import declare
from ..base.spin import run_node
from ..base.subscription_wait import SubscriptionWait
from .player import PlantMessages, PlantPlayer

_TOPICS = {
    JointState: "measured/joint_states",
    Temperature: "measured/oil_temperature",
    EncoderBlock: "measured/encoders",
    SampledBlock: "measured/vibration",
}
_KEPT = QoSProfile(depth=1000)
_LAST = Duration(seconds=10.0)  # longest wait until the last messages have arrived


class Plant(ManagedNode):
    """Publishes the measurements of a plant once, in real time; then the node ends."""

    def __init__(self) -> None:
        super().__init__("plant")
        declare(self, "scene", "paper", "packaged scene, or path of a YAML file")
        declare(
            self, "hidden", "", "YAML file with laws, duty, changes and sensor errors; empty: none"
        )
        declare(self, "duration", 60.0, "duration of the run [s]", (0.1, 86_400.0))
        declare(self, "input_joint", "input_joint", "joint of the input")
        declare(self, "output_joint", "output_joint", "joint of the output")
        declare(self, "frame_id", "gearbox", "base frame of the gearbox")
        # rclpy derives the type of a list from its first element.
        declare(self, "wait_for", [""], "nodes that must subscribe before the run starts")
        self._measured: Iterator[Measured] = iter(())
        self._messages: PlantMessages | None = None
        self._waits: list[SubscriptionWait] = []
        self._player: PlantPlayer | None = None
        self._outlets: dict[type, LifecyclePublisher] = {}

    def configure(self) -> None:
        """Create the publishers, and simulate the vibration of the plant."""
        given = {n: p.value for n, p in self.get_parameters_by_prefix("").items()}
        scene = pt.load_scene(given["scene"])
        hidden = self._hidden(given["hidden"], scene)
        played = Played(scene, hidden, given["duration"])
        sensors = hidden.sensors
        rates = {EncoderBlock: sensors.encoders.rate, SampledBlock: sensors.vibration.rate}
        self._outlets = {
            kind: self.create_lifecycle_publisher(kind, topic, _KEPT)
            for kind, topic in _TOPICS.items()
            if rates.get(kind, math.inf)
        }
        joints = given["input_joint"], given["output_joint"]
        self._messages = PlantMessages(joints, sensors, given["frame_id"])
        self._waits = [SubscriptionWait(self, name) for name in given["wait_for"] if name]
        measured = timeline(played)
        self._measured = itertools.chain([next(measured)], measured)  # the first takes seconds

    def activate(self) -> None:
        """Publish from the beginning, or from the time of the pause."""
        if self._messages is None:
            raise ValueError("the node is not configured")
        for wait in self._waits:
            wait.begin()
        self._player = PlantPlayer(self._measured, self._messages, self)
        self.get_logger().info(f"publishing measurements of {self.get_parameter('scene').value}")
        if not has_time(self.get_clock()):
            self.get_logger().warning(CLOCK_AWAITED)

    def deactivate(self) -> None:
        """Pause the run."""
        if self._player is not None:
            self._player.stop()
            self._player = None

    def close(self) -> None:
        """Release the publishers."""
        self.deactivate()
        for publisher in self._outlets.values():
            self.destroy_lifecycle_publisher(publisher)
        self._outlets, self._messages = {}, None

    # Called by the player, in its thread.

    def ready(self) -> bool:
        """Return whether ROS time is available and the nodes in `wait_for` have subscribed."""
        return has_time(self.get_clock()) and all(wait.present() for wait in self._waits)

    def now(self) -> int:
        """Return the ROS time [ns]."""
        return int(self.get_clock().now().nanoseconds)

    def play(self, message: Any) -> None:
        """Publish a message."""
        self._outlets[type(message)].publish(message)

    def ended(self, defect: Exception | None) -> None:
        """End the process once the last messages are acknowledged."""
        if not self.context.ok():
            return
        if defect is not None:
            self.get_logger().error("".join(traceback.format_exception(defect)))
            self.fail(f"the run stopped: {defect}")
            return
        for publisher in self._outlets.values():
            publisher.wait_for_all_acked(_LAST)
        self.get_logger().info("the run has ended")
        shut_down(self.context)

    def _hidden(self, name: str, scene: pt.Scene) -> Hidden:
        if not name:
            return Hidden()
        path = Path(name).expanduser()
        try:
            return read_hidden(path, scene)
        except OSError as reason:
            raise ValueError(f"hidden = {str(path)!r}: {reason.strerror}") from None


def main(args: list[str] | None = None) -> int:
    """Run the node until its end or a signal; returns the exit code."""
    return run_node(Plant, args)
