"""The simulation node: a twin in real time, its parameters and services."""

from __future__ import annotations

import gc
import math
import sys
from collections.abc import Iterator, Mapping
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from planetary_twin_msgs.srv import NaturalModes
from rclpy.parameter import Parameter
from sensor_msgs.msg import JointState

import planetary_twin_py as pt
from planetary_twin_py.checks.fixed_axes import held_axes_warning
from planetary_twin_py.robot import robot_description
from planetary_twin_py.run.limits import RunawayError
from planetary_twin_py.run.quality_control import QualityControl, Setting
from planetary_twin_py.sensors.remarks import alias_remarks

from ..base.clock import CLOCK_AWAITED
from ..base.diagnostics import Row, diagnostics
from ..base.lifecycle_node import NodeError
from ..base.polled_subscription import PolledSubscription
from ..base.spin import run_node
from ..base.subscription_wait import SubscriptionWait
from . import standard_services
from .diagnostics.intervals import IntervalReports, dynamics_row
from .diagnostics.real_time import KEEPS_UP
from .live.backlog import Backlog
from .live.live_twin import NO_CLOCK, LiveTwin
from .operating_point import OperatingPointControl
from .publishing.publishers import STALL, Telemetry
from .running import RunningSimulation
from .shaft_commands import QOS, ShaftCommands
from .time_services import TimeServices

_REPORT_PERIOD = 1.0  # [s]
# Time after which a waiting thread may take the interpreter lock from a busy one. Python's default
# of 5 ms is half an interval: clients that send many requests would delay the twin.
_SWITCH_INTERVAL = 2e-4  # [s]


class Simulation(RunningSimulation):
    """Runs a scene: `configure` builds the model, `activate` runs it, `deactivate` pauses it."""

    def __init__(self, given: Mapping[str, Any] | None = None) -> None:
        super().__init__(given)
        self._urdf = ""
        self._verdict = KEEPS_UP
        self._other_publishers = 0
        self._intervals = IntervalReports()
        self._checked: pt.Scene | None = None  # by `_check_held_axes`
        self._before: Telemetry | None = None  # the closed one of the previous configuration
        self._wait: SubscriptionWait | None = None
        self._commands: ShaftCommands | None = None
        self._faulty: set[str] = set()  # names of reports with a fault
        self._inlet: PolledSubscription | None = None
        self._point = OperatingPointControl(self)
        self._backlog: Backlog | None = None
        self.create_service(NaturalModes, "~/natural_modes", self._natural_modes)
        TimeServices(self)
        if standard_services.AVAILABLE:
            standard_services.SimulationServices(self)

    def configure(self) -> None:
        """Create the publishers, so that subscribers find them, and build the model."""
        self._given.read()
        self._pick_dynamics()
        scene, settings = self._given.scene, self._given.settings
        self._telemetry = Telemetry(self, self._given, self._before)
        self._inlet = PolledSubscription(self, JointState, "~/command", QOS)
        now, take = self._time_of_stamps, self._take_commands
        self._commands = ShaftCommands(scene, settings, now, take)
        self._wait = SubscriptionWait(self, settings.wait_for)
        # Half of what publishers keep: messages in transit do not fill the rest.
        room = round(0.5 * STALL * settings.publish_rate)
        self._backlog = Backlog(self, settings.wait_for, self._telemetry.streamed, room)
        self._urdf = robot_description(scene.gearset, settings.frame_id, scene.sensors)
        self._twin = self._new_twin()
        self._check_held_axes(self._twin)
        # Exclude the objects loaded so far from garbage collection: scanning them takes 0.1 s.
        gc.collect()
        gc.freeze()

    def activate(self) -> None:
        """Run from the twin's present time, with the present parameters."""
        twin = self._running_twin()
        try:
            self._commands.release(twin)
            twin.set(**self._given.changes_of(twin))
        except RunawayError as reason:
            raise NodeError(f"{reason}; clean up and configure the node for a new run") from None
        settings, quality = self._given.settings, self._given.quality(twin)
        outputs, commands = self._telemetry, self._commands
        self._wait.begin()
        self.live = LiveTwin(
            twin, self.interval, settings.rate_factor, quality, self, outputs, commands
        )
        self._report = self._new_report(twin, self.live.start())
        self.every(_REPORT_PERIOD, self._diagnose)
        self._telemetry.describe(self._urdf)
        self.get_logger().info(f"runs {twin.scene.name} from {twin.time:g} s")
        if not self._telemetry.has_clock():
            self.get_logger().warning(CLOCK_AWAITED)

    def deactivate(self) -> None:
        """Stop after the interval in progress; the last report counts every message."""
        live, self.live = self.live, None
        if live is not None:
            live.stop()
            self._diagnose(live, last=True)

    def close(self) -> None:
        """Release the model and the subscriptions."""
        live, self.live = self.live, None
        if live is not None:
            live.stop()
        self._twin = self._report = self._wait = None
        for each in (self._inlet, self._backlog):
            if each is not None:
                each.close()
        self._inlet = self._backlog = None
        self._before, self._telemetry = self._telemetry or self._before, None

    # Called by the live twin, in its thread, or in that of a command while it halts.

    def computed(self, window: pt.Window) -> None:
        """Check an interval and its sensors before the wall time of its end."""
        self._intervals.add(window)
        for readings in window.sensors.values():
            for line in alias_remarks(readings):
                self.get_logger().warning(f"sensor {line}")

    def ready(self) -> bool:
        """Return whether ROS time is available and the node `wait_for` has subscribed."""
        return self._telemetry.has_clock() and self._wait.present()

    def has_room(self) -> bool:
        """Return whether the node that `wait_for` names has kept up with recording."""
        return self._backlog.has_room()

    def refused(self, reason: str) -> None:
        """Warn of a ramp that ended before its final values, or of a command without effect."""
        self.get_logger().warning(reason, throttle_duration_sec=_REPORT_PERIOD)

    def retuned(self, instant: float, before: Setting, quality: QualityControl) -> None:
        """Log the setting in force and its reason."""
        now, load = quality.setting, quality.load
        why = "as set" if math.isnan(load) else f"computing takes {load:.0%} of the available time"
        text = (
            f"tolerance {now.tolerance:g}, waveform at {now.sample_rate:g} Hz "
            f"from {instant:g} s: {why}"
        )
        if now.sample_rate < before.sample_rate:
            self.get_logger().warning(text)
        else:
            self.get_logger().info(text)

    def stopped(self, defect: Exception) -> None:
        """Report the exception that ended the thread."""
        self.broke("the twin", defect)

    def remark(self, parameters: list[Parameter]) -> str:
        """Return which of `parameters` have no effect, and whether the twin now waits."""
        remarks = [self._given.remark(parameters)]
        clock_changed = any(p.name == "use_sim_time" for p in parameters)
        if clock_changed and self.live is not None and not self._telemetry.has_clock():
            remarks.append(NO_CLOCK)
        return "; ".join(filter(None, remarks))

    def _take_commands(self) -> list[tuple[int, JointState]]:
        """Return the commands that have arrived, as many as the subscription holds at most."""
        return self._inlet.take(QOS.depth)

    def _time_of_stamps(self) -> int:
        """Return the ROS time [ns]; a source of /clock does not wait for its own messages."""
        if self._given.settings.clock:
            return self._telemetry.stamps.newest
        return int(self.get_clock().now().nanoseconds)

    def _natural_modes(
        self, request: NaturalModes.Request, response: NaturalModes.Response
    ) -> NaturalModes.Response:
        modes = pt.natural_modes(self._given.scene)
        response.frequencies = [float(frequency) for frequency in modes.frequencies]
        response.kinds = list(modes.kinds)
        return response

    # Diagnostics.

    def _diagnose(self, live: LiveTwin | None = None, *, last: bool = False) -> None:
        live, report = live or self.live, self._report
        if live is None or report is None:
            return

        def report_now(published: Mapping[str, int]) -> DiagnosticArray:
            stamps = self._telemetry.stamps
            first = report.row(live.progress, live.quality, published, stamps, last=last)
            if report.verdict != self._verdict:
                self._verdict = report.verdict
                self._log(first)
            return diagnostics([first, *self._rows()], self.get_namespace())

        self._check_held_axes(self._running_twin())
        self._telemetry.diagnose(report_now)
        self._warn_of_other_publishers()

    def _rows(self) -> Iterator[Row]:
        """Yield the reports beside that on real time."""
        yield from self._intervals.rows()
        if self._given.choice is not None:
            yield dynamics_row(self._given.choice, self._running_twin().operating_point)
        if self._running_twin().ports.given:
            yield self._noted(self._commands.row())
        if self._given.settings.wait_for:
            yield self._noted(self._wait.row())

    def _noted(self, row: Row) -> Row:
        """Log a fault of `row` when it begins; returns `row`."""
        if row.level == DiagnosticStatus.OK:
            self._faulty.discard(row.report)
        elif row.report not in self._faulty:
            self._faulty.add(row.report)
            self._log(row)
        return row

    def _check_held_axes(self, twin: pt.Twin) -> None:
        """Find out again whether axes may be held, if the load has changed."""
        checked = twin.scene.model_copy(update={"operating_point": twin.operating_point})
        if checked == self._checked:
            return
        self._checked = checked
        before, self._intervals.lasting = self._intervals.lasting, held_axes_warning(checked)
        if self._intervals.lasting and not before:
            self.get_logger().warning(self._intervals.lasting)

    def _warn_of_other_publishers(self) -> None:
        """Warn once of each other publisher of the state: subscribers receive both."""
        before = self._other_publishers
        self._other_publishers = self.count_publishers("gearbox_state") - 1
        if self._other_publishers > before:
            self.get_logger().warning("gearbox_state has another publisher: a replay, or a twin")

    def _log(self, row: Row) -> None:
        # One call for each level: rclpy refuses a call with a varying level.
        if row.level == DiagnosticStatus.OK:
            self.get_logger().info(row.message)
        elif row.level == DiagnosticStatus.WARN:
            self.get_logger().warning(row.message)
        else:
            self.get_logger().error(row.message)


def main(args: list[str] | None = None) -> int:
    """Run the node until a signal ends it; returns the exit code."""
    sys.setswitchinterval(_SWITCH_INTERVAL)
    return run_node(Simulation, args)
