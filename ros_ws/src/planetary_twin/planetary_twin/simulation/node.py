"""The simulation node: a twin in real time, its parameters and services."""

from __future__ import annotations

import gc
import math
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from planetary_twin_msgs.srv import NaturalModes
from rclpy.parameter import Parameter
from sensor_msgs.msg import JointState

import planetary_twin_py as pt
from planetary_twin_py.checks.fixed_axes import held_axes_warning
from planetary_twin_py.checks.tooth_entry import entry_warning_at
from planetary_twin_py.robot import robot_description
from planetary_twin_py.run.limits import RunawayError
from planetary_twin_py.run.quality_control import QualityControl, Setting
from planetary_twin_py.sensors.remarks import alias_remarks

from ..base.clock import CLOCK_AWAITED
from ..base.damage import SAVED, damage_row, path_of, serve_damage
from ..base.diagnostics import Row, diagnostics
from ..base.lifecycle_node import NodeError
from ..base.polled_subscription import PolledSubscription
from ..base.spin import run_node
from ..base.subscription_wait import SubscriptionWait
from . import standard_services
from .damage import SimulatedDamage
from .diagnostics.intervals import IntervalReports, dynamics_row
from .diagnostics.real_time import KEEPS_UP
from .diagnostics.temperatures import temperature_row
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

    # From `configure` on:
    _wait: SubscriptionWait
    _commands: ShaftCommands
    _inlet: PolledSubscription
    _backlog: Backlog

    def __init__(self, given: Mapping[str, Any] | None = None) -> None:
        super().__init__(given)
        self._urdf = ""
        self._verdict = KEEPS_UP
        self._other_publishers = 0
        self._intervals = IntervalReports()
        self._checked: pt.Scene | None = None  # by `_check_load`
        self._before: Telemetry | None = None  # that of the last configuration
        self._faulty: set[str] = set()  # names of reports with a fault
        self._point = OperatingPointControl(self)
        serve_damage(self, self._save_damage, self._replace_part)
        self.create_service(NaturalModes, "~/natural_modes", self._natural_modes)
        TimeServices(self)
        if standard_services.AVAILABLE:
            standard_services.SimulationServices(self)

    def configure(self) -> None:
        """Create the publishers, so that subscribers find them, and build the model."""
        self._given.read()
        self._pick_dynamics()
        scene, settings = self._given.scene, self._given.settings
        self._damage = self._damage_of(scene)
        self._telemetry = self._before = Telemetry(self, self._given, self._before, self._damage)
        self._inlet = self.opened(PolledSubscription(self, JointState, "~/command", QOS))
        now, take = self._time_of_stamps, self._take_commands
        self._commands = ShaftCommands(scene, settings, now, take)
        self._wait = SubscriptionWait(self, settings.wait_for)
        # Half of what publishers keep: messages in transit do not fill the rest.
        room = round(0.5 * STALL * settings.publish_rate)
        backlog = Backlog(self, settings.wait_for, self._telemetry.streamed, room)
        self._backlog = self.opened(backlog)
        self._urdf = robot_description(scene.gearset, settings.frame_id, scene.sensors)
        self._twin = self._new_twin()
        self._check_load(self._twin)
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
        self.every(SAVED, self._keep_damage)
        self._telemetry.describe(self._urdf)
        self.get_logger().info(f"runs {twin.scene.name} from {twin.time:g} s")
        if not self._telemetry.has_clock():
            self.get_logger().warning(CLOCK_AWAITED)

    def deactivate(self) -> None:
        """Stop after the interval in progress; the last report counts every message."""
        live, self.live = self.live, None
        if live is not None:
            live.stop()
            self._keep_damage()
            self._diagnose(live, last=True)

    def close(self) -> None:
        """Release the model."""
        live, self.live = self.live, None
        if live is not None:
            live.stop()
            self._keep_damage()
        self._damage = None
        self._twin = self._report = None

    def _damage_of(self, scene: pt.Scene) -> SimulatedDamage | None:
        """Return the damage of `scene`, written at once: a refusal comes at the start."""
        path = path_of(self._given.settings.damage_file)
        if scene.durability is None:
            if path is not None:
                raise ValueError("damage_file: the scene needs its section durability")
            return None
        damage = SimulatedDamage(scene, path)
        if damage.has_file:
            damage.save()
        return damage

    def _keep_damage(self) -> None:
        """Write the file of the damage, if there is one; a failure is reported."""
        if self._damage is None or not self._damage.has_file:
            return
        try:
            self._damage.save()
        except (ValueError, OSError):
            self.get_logger().error(self._damage.fault)

    def _counted_damage(self) -> SimulatedDamage:
        if self._damage is None:
            raise ValueError("damage is not counted: the scene needs its section durability")
        return self._damage

    def _save_damage(self) -> Path:
        return self._counted_damage().save()

    def _replace_part(self, name: str) -> tuple[str, ...]:
        """Set the damage of a part to 0 between two intervals, and write the file at once."""
        damage, parts = self._counted_damage(), list[str]()

        def replace(twin: pt.Twin) -> None:
            parts.extend(damage.replace_part(name, twin.time))

        self.running().between(replace).result(self.longest_wait)
        self._keep_damage()
        return tuple(parts)

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

        self._check_load(self._running_twin())
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
        if (thermal := self._telemetry.thermal) is not None:
            yield self._noted(temperature_row(thermal))
        if self._damage is not None:
            row = damage_row("simulation: damage", self._damage.state, self._damage.fault)
            yield self._noted(row)

    def _noted(self, row: Row) -> Row:
        """Log a fault of `row` when it begins; returns `row`."""
        if row.level == DiagnosticStatus.OK:
            self._faulty.discard(row.report)
        elif row.report not in self._faulty:
            self._faulty.add(row.report)
            self._log(row)
        return row

    def _check_load(self, twin: pt.Twin) -> None:
        """Find out again what is wrong under the present load, if it has changed."""
        point = twin.log[-1].point  # without the temperature of oil that is a state
        checked = twin.scene.model_copy(update={"operating_point": point})
        if checked == self._checked:
            return
        self._checked = checked
        found = held_axes_warning(checked), entry_warning_at(twin.start, point)
        before, lasting = self._intervals.lasting, "; also: ".join(line for line in found if line)
        self._intervals.lasting = lasting or None
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
