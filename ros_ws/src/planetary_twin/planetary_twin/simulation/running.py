"""The running twin of a simulation, on which its services and parameters act."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from concurrent.futures import Future
from typing import Any

from sensor_msgs.msg import JointState

import planetary_twin_py as pt
from planetary_twin_py.recording.ros2.given import joint_names, values_of
from planetary_twin_py.run.limits import RunawayError

from ..base.lifecycle_node import ManagedNode, NodeError
from .damage import SimulatedDamage
from .diagnostics.real_time import RealTimeReport
from .live.live_twin import LiveTwin
from .parameters import SimulationParameters
from .progress import Progress
from .publishing.publishers import Telemetry
from .shaft_commands import fault_of_names, names_given


class RunningSimulation(ManagedNode):
    """The node of a simulation; `live` is its twin while it is active."""

    _telemetry: Telemetry  # from `configure` on

    def __init__(self, given: Mapping[str, Any] | None) -> None:
        super().__init__("simulation", given)
        self._given = SimulationParameters(self)
        self.live: LiveTwin | None = None
        self._twin: pt.Twin | None = None
        self._report: RealTimeReport | None = None
        self._damage: SimulatedDamage | None = None

    @property
    def longest_wait(self) -> float:
        """Longest wait for a command [s], which is executed between two intervals."""
        return 2.0 * self._given.settings.period + 1.0

    @property
    def interval(self) -> float:
        """Return the simulated time of a published interval [s]."""
        return 1.0 / self._given.settings.publish_rate

    @property
    def severities(self) -> Collection[str]:
        """Return the names of the severities of faults, which may be set."""
        return self._given.scene.severities

    def renew_quality(self) -> None:
        """Apply the parameter `tolerance` to the live twin."""
        if self.live is not None:
            self.live.quality = self._given.quality(self._running_twin())

    def running(self) -> LiveTwin:
        """Return the live twin."""
        if self.live is None:
            raise ValueError("the simulation is not active, so its time does not advance")
        return self.live

    def command(self, message: JointState) -> dict[str, float]:
        """Return what a command gives at the ports, as arguments of `Twin.advance`."""
        joints = joint_names(self._given.scene)
        if fault := fault_of_names(message, joints):
            raise ValueError(f"command: has {fault}")
        if not message.name:
            return {}
        values = values_of(message, joints)
        if not values:
            raise ValueError(
                f"command: must have an effort, velocity or position of {' or '.join(joints)}; "
                f"{names_given(message)}"
            )
        return values

    def reset(self) -> Future[float]:
        """Start again at time zero, at the operating point of the parameters."""
        live, twin = self.running(), self._new_twin()
        instant = live.restart(twin)
        instant.result(timeout=self.longest_wait)
        self._twin = twin
        self._report = self._new_report(twin, live.progress)
        return instant

    def stamp(self, instant: float) -> int:
        """Return the ROS time [ns] of a simulated instant [s]."""
        return self._telemetry.stamp(instant)

    def _pick_dynamics(self) -> None:
        try:
            self._given.pick_dynamics()
        except RunawayError as reason:
            raise ValueError(str(reason)) from None
        if self._given.choice is not None:
            self.get_logger().info(self._given.choice.text)

    def _new_twin(self) -> pt.Twin:
        scene = self._given.scene_now()
        if self._damage is not None:
            scene = self._damage.warmed(scene)
        try:
            return pt.Twin(scene, sample_rate=self._given.settings.sample_rate)
        except RunawayError as reason:
            raise ValueError(str(reason)) from None

    def _new_report(self, twin: pt.Twin, start: Progress) -> RealTimeReport:
        settings = self._given.settings
        return RealTimeReport(settings.rate_factor, settings.period, twin.log, start)

    def _running_twin(self) -> pt.Twin:
        if self._twin is None:
            raise NodeError("the model is not built: configure the node first")
        return self._twin
