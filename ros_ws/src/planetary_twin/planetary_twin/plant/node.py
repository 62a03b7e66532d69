"""The plant node: publishes simulated measurements of a gearbox with hidden changes."""

from __future__ import annotations

import itertools
import math
import threading
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rclpy.duration import Duration
from rclpy.lifecycle import LifecyclePublisher
from rclpy.qos import QoSProfile

import planetary_twin_py as pt
from planetary_twin_py.following.channels.all import OIL
from planetary_twin_py.following.channels.sampled import DEVICES
from planetary_twin_py.plant.hidden import Hidden, read_hidden
from planetary_twin_py.plant.readings import Plant as Played
from planetary_twin_py.plant.timeline import Measured, timeline

from ..base.clock import CLOCK_AWAITED, has_time
from ..base.lifecycle_node import ManagedNode, shut_down
from ..base.parameters import declare_settings, read_named, setting, settings_of
from ..base.spin import run_node
from ..base.subscription_wait import SubscriptionWait
from ..base.topics import MEASURED, message_class
from .messages import SHAFTS, PlantMessages

_KEPT = QoSProfile(depth=1000)
_LAST = Duration(seconds=10.0)  # longest wait until the last messages have arrived
_POLL = 0.05  # [s] between two checks whether the run may begin


@dataclass(frozen=True)
class PlantSettings:
    """What to measure; may change until the node is configured."""

    scene: str = setting("paper", "packaged scene, or path of a YAML file")
    hidden: str = setting("", "YAML file with laws, duty, changes and sensor errors; empty: none")
    duration: float = setting(60.0, "duration of the run [s]", (0.1, 86_400.0))
    input_joint: str = setting("input_joint", "joint of the input")
    output_joint: str = setting("output_joint", "joint of the output")
    frame_id: str = setting("gearbox", "base frame of the gearbox")
    wait_for: Sequence[str] = setting([""], "nodes that must subscribe before the run starts")


class Plant(ManagedNode):
    """Publishes the measurements of a plant once, in real time; then the node ends."""

    _messages: PlantMessages  # from `configure` on

    def __init__(self) -> None:
        super().__init__("plant")
        declare_settings(self, PlantSettings)
        self._measured: Iterator[Measured] = iter(())
        self._waits: list[SubscriptionWait] = []
        self._outlets: dict[str, LifecyclePublisher] = {}
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None

    def configure(self) -> None:
        """Create the publishers, and simulate the vibration of the plant."""
        given = settings_of(self, PlantSettings)
        scene = pt.load_scene(given.scene)
        hidden = Hidden()
        if given.hidden:
            hidden = read_named("hidden", given.hidden, lambda path: read_hidden(path, scene))
        measuring = [name for name in DEVICES if hidden.device(name).rate]
        for topic in (SHAFTS, OIL, *measuring):
            name = f"measured/{topic}"
            self._outlets[topic] = self.outlet(message_class(MEASURED[name]), name, _KEPT)
        joints = given.input_joint, given.output_joint
        self._messages = PlantMessages(joints, hidden, given.frame_id)
        self._waits = [SubscriptionWait(self, name) for name in given.wait_for if name]
        measured = timeline(Played(scene, hidden, given.duration))
        self._measured = itertools.chain([next(measured)], measured)  # the first takes seconds

    def activate(self) -> None:
        """Publish from the beginning, or from the time of the pause."""
        for wait in self._waits:
            wait.begin()
        self._stop.clear()
        self._thread = threading.Thread(target=self._run, name="plant", daemon=True)
        self._thread.start()
        self.get_logger().info(f"publishing measurements of {self.get_parameter('scene').value}")
        if not has_time(self.get_clock()):
            self.get_logger().warning(CLOCK_AWAITED)

    def deactivate(self) -> None:
        """Pause the run."""
        self._stop.set()
        if self._thread is not None:
            self._thread.join()
            self._thread = None

    def close(self) -> None:
        """End the run."""
        self.deactivate()

    def _run(self) -> None:
        """Publish the measurements, and end the process once the last ones are acknowledged."""
        try:
            complete = self._play()
        except Exception as defect:
            self.broke("the run", defect)
            return
        if not complete or not self.context.ok():
            return
        for publisher in self._outlets.values():
            publisher.wait_for_all_acked(_LAST)
        self.get_logger().info("the run has ended")
        shut_down(self.context)

    def _play(self) -> bool:
        """Publish each measurement at its time; return False if the run is paused before."""
        while not self._is_ready():
            if self._stop.wait(_POLL):
                return False
        begin, origin = math.nan, 0
        for one in self._measured:
            if math.isnan(begin):
                begin = time.monotonic() - one.time
                origin = self.get_clock().now().nanoseconds - round(one.time * 1e9)
            if self._stop.wait(max(begin + one.time - time.monotonic(), 0.0)):
                self._measured = itertools.chain([one], self._measured)
                return False
            topic, message = self._messages.message(one, origin)
            self._outlets[topic].publish(message)
        return True

    def _is_ready(self) -> bool:
        """Return whether ROS time is available and the nodes in `wait_for` have subscribed."""
        return has_time(self.get_clock()) and all(wait.present() for wait in self._waits)


def main(args: list[str] | None = None) -> int:
    """Run the node until its end or a signal; returns the exit code."""
    return run_node(Plant, args)
