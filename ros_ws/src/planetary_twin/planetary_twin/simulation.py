"""The simulation node: a twin in real time, its parameters and its service."""

from __future__ import annotations

import gc
import math
import sys
import traceback
from collections.abc import Mapping
from concurrent.futures import Future

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from planetary_twin_msgs.srv import NaturalModes, SetOperatingPoint
from rclpy.parameter import Parameter

import planetary_twin_py as pt
from planetary_twin_py.quality_control import QualityControl, Setting
from planetary_twin_py.robot import robot_description
from planetary_twin_py.runaway import RunawayError

from . import simulation_services
from .accuracy_report import AccuracyReport
from .audience import Audience
from .backlog import Backlog
from .ledger_report import LedgerReport
from .live import LiveTwin, Progress
from .managed import ManagedNode, NodeError, run_node
from .parameters import brief
from .ramps import LONGEST_RAMP
from .real_time import KEEPS_UP, RealTimeReport
from .simulation_parameters import TOLERANCE, SimulationParameters, tunables
from .simulation_services import SimulationServices
from .stamps import STEADY
from .telemetry import STALL, Telemetry
from .time_services import TimeServices

_REPORT_PERIOD = 1.0  # [s]
# After which a thread that waits may take the interpreter from one that is busy: Python's 5 ms,
# half an interval, would let clients that ask all the time hold the twin up.
_SWITCH_INTERVAL = 2e-4  # [s]


class Simulation(ManagedNode):
    """Runs a scene in real time: configure builds it, activate starts it, deactivate pauses it."""

    def __init__(self) -> None:
        super().__init__("simulation")
        self._twin: pt.Twin | None = None
        self._live: LiveTwin | None = None
        self._report: RealTimeReport | None = None
        self._urdf = ""
        self._verdict = KEEPS_UP
        self._company = 0
        self._submitted: Future[float] | None = None
        self._ramp = 0.0  # [s] in which what is being set is to be reached
        self._given = SimulationParameters(self)
        self._ledger = LedgerReport(self.get_namespace())
        self._accuracy = AccuracyReport(self.get_namespace())
        self._telemetry: Telemetry | None = None
        self._before: Telemetry | None = None  # of the life before, closed
        self._audience: Audience | None = None
        self.add_post_set_parameters_callback(self._submit)
        self._backlog: Backlog | None = None
        self._timer = self.create_timer(_REPORT_PERIOD, self._diagnose, clock=STEADY)
        self.create_service(SetOperatingPoint, "~/set_operating_point", self._set_operating_point)
        self.create_service(NaturalModes, "~/natural_modes", self._natural_modes)
        TimeServices(self, self)
        if simulation_services.AVAILABLE:
            SimulationServices(self, self, lambda: 1.0 / self._given.rate)

    def configure(self) -> None:
        """Offer the topics, so that others find them, and build the model as parameters say."""
        self._given.read()
        self._telemetry = Telemetry(self, self._given, self._before)
        self._audience = Audience(self, self._given.wait_for)
        # Half of what publishers keep: what is on its way meanwhile does not fill the rest.
        room = round(0.5 * STALL * self._given.rate)
        self._backlog = Backlog(self, self._given.wait_for, self._telemetry.streamed, room)
        self._urdf = robot_description(self._given.scene.gearset, self._given.frame)
        self._twin = self._new_twin()
        # What is loaded now stays: a collection that looks at it all takes a tenth of a second.
        gc.collect()
        gc.freeze()

    def activate(self) -> None:
        """Run from where the twin stands, with what was set while it stood."""
        twin = self._running_twin()
        try:
            twin.set(**self._given.point())
        except RunawayError as reason:
            raise NodeError(f"{reason}; clean up and configure the node for a new run") from None
        given, quality = self._given, self._given.quality(twin)
        self._audience.begin()
        self._live = LiveTwin(twin, 1.0 / given.rate, given.rate_factor, quality, self)
        self._report = self._new_report(twin, self._live.start())
        self._telemetry.describe(self._urdf)
        self.get_logger().info(f"runs {twin.scene.name} from {twin.time:g} s on")
        if not self._telemetry.ready():
            self.get_logger().warning("use_sim_time: waits for the first message on /clock")

    def deactivate(self) -> None:
        """Stop after the interval in progress; the last report counts every message."""
        live, self._live = self._live, None
        if live is not None:
            live.stop()
            self._diagnose(live, last=True)

    def close(self) -> None:
        """Let the model go."""
        live, self._live = self._live, None
        if live is not None:
            live.stop()
        self._twin = self._report = self._audience = None
        if self._backlog is not None:
            self._backlog.close()
            self._backlog = None
        if self._telemetry is not None:
            self._telemetry.close()
            self._before, self._telemetry = self._telemetry, None

    # Called by the live twin, in its thread.

    def prepare(self, window: pt.Window) -> None:
        """Turn an interval into messages ahead of its wall instant."""
        self._telemetry.prepare(window)
        self._ledger.add(window)
        self._accuracy.add(window)

    def publish(self) -> None:
        """Send them at that instant."""
        self._telemetry.publish()

    def changed(self, point: pt.OperatingPoint, instant: float) -> None:
        """Tell of a new operating point."""
        self._telemetry.announce(point, instant)

    def ready(self) -> bool:
        """Whether there is a ROS time to stamp with, and who is waited for is there."""
        return self._telemetry.ready() and self._audience.there()

    def has_room(self) -> bool:
        """Whether the node that `wait_for` names has kept up with recording."""
        return self._backlog.has_room()

    def goes_on(self, twin: pt.Twin) -> None:
        """Let the twin's present time be now."""
        self._telemetry.begin(twin.time)
        if twin.time == 0.0:
            self._telemetry.originate(twin.scene)

    def refused(self, reason: str) -> None:
        """Say why a ramp has ended where it is."""
        self.get_logger().warning(f"a ramp ends on its way: {reason}")

    def retuned(self, instant: float, before: Setting, quality: QualityControl) -> None:
        """Say which setting holds, and why."""
        now, load = quality.setting, quality.load
        why = "as set" if math.isnan(load) else f"an interval cost {load:.0%} of its time"
        text = (
            f"tolerance {now.tolerance:g}, waveform at {now.sample_rate:g} Hz "
            f"from {instant:g} s: {why}"
        )
        if now.sample_rate < before.sample_rate:
            self.get_logger().warning(text)
        else:
            self.get_logger().info(text)

    def stopped(self, defect: Exception) -> None:
        """Tell of the reason; a publisher refuses once a signal has shut ROS down."""
        if not self.context.ok():
            return
        if not isinstance(defect, (ValueError, ArithmeticError)):
            self.get_logger().error("".join(traceback.format_exception(defect)))
        self.fail(f"the twin stopped: {defect}")

    # Time, see `time_services`.

    def running(self) -> LiveTwin:
        """Return the live twin."""
        if self._live is None:
            raise ValueError("the simulation is not active, so its time stands still")
        return self._live

    def reset(self) -> Future[float]:
        """Begin anew, at the operating point that the parameters give."""
        live, twin = self.running(), self._new_twin()
        instant = live.restart(twin)
        instant.result(timeout=self._longest_wait)
        self._twin = twin
        self._report = self._new_report(twin, live.progress)
        return instant

    def stamp(self, instant: float) -> int:
        """ROS time [ns] of a simulated instant [s]."""
        return self._telemetry.stamp(instant)

    def _submit(self, parameters: list[Parameter]) -> None:
        if self._live is None:
            return
        if any(p.name == TOLERANCE.name for p in parameters):
            self._live.quality = self._given.quality(self._running_twin())
        values = tunables(parameters)
        if not values:
            return
        before = self._submitted
        if self._ramp > 0.0:
            self._submitted = self._live.ramp(values, self._ramp)
        else:
            self._submitted = self._live.submit(values)
        if self._submitted is not before:  # changes between two intervals are one
            self._submitted.add_done_callback(self._report_refusal)

    def _report_refusal(self, submitted: Future[float]) -> None:
        """Say why the twin does not follow its parameters though they are within their ranges."""
        refusal = submitted.exception()
        if refusal is not None and self._live is not None:
            self.get_logger().warning(f"the twin does not follow its parameters: {refusal}")

    def _set_operating_point(
        self, request: SetOperatingPoint.Request, response: SetOperatingPoint.Response
    ) -> SetOperatingPoint.Response:
        try:
            instant = self._change(request.names, request.values, request.ramp)
        except (ValueError, TimeoutError) as refusal:
            response.success, response.message = False, str(refusal)
            return response
        response.success = True
        response.simulated_time = instant
        response.stamp.sec, response.stamp.nanosec = divmod(
            self._telemetry.stamp(instant), 1_000_000_000
        )
        return response

    def _change(self, names: list[str], values: list[float], ramp: float) -> float:
        """Set parameters and wait for the instant [s] at which the twin begins to follow."""
        if not 0.0 <= ramp <= LONGEST_RAMP:
            raise ValueError(f"ramp = {ramp:g} s: must be within 0 and {LONGEST_RAMP:g}")
        if len(names) != len(values) or not names:
            raise ValueError(
                f"{len(names)} names for {len(values)} values: one each, at least one"
            )
        for name in names:
            if name not in pt.TUNABLES:
                raise ValueError(
                    f"{brief(name)}: no such quantity; there are {', '.join(pt.TUNABLES)}"
                )
            if list(names).count(name) > 1:
                raise ValueError(f"{name}: named twice")
        if self._live is None:
            raise ValueError("the simulation is not active, so there is no instant to change at")
        parameters = [
            Parameter(name, Parameter.Type.DOUBLE, value)
            for name, value in zip(names, values, strict=True)
        ]
        self._ramp = ramp
        try:
            result = self.set_parameters_atomically(parameters)
        finally:
            self._ramp = 0.0
        if not result.successful or self._submitted is None:
            raise ValueError(result.reason)
        return self._submitted.result(timeout=self._longest_wait)

    @property
    def _longest_wait(self) -> float:
        """Orders are taken up between two intervals, so this wait [s] is one interval long."""
        return 2.0 * self._given.period + 1.0

    def _natural_modes(
        self, request: NaturalModes.Request, response: NaturalModes.Response
    ) -> NaturalModes.Response:
        modes = pt.natural_modes(self._given.scene)
        response.frequencies = [float(frequency) for frequency in modes.frequencies]
        response.kinds = list(modes.kinds)
        return response

    # Diagnostics.

    def _diagnose(self, live: LiveTwin | None = None, *, last: bool = False) -> None:
        live, report = live or self._live, self._report
        if live is None or report is None:
            return

        def report_now(published: Mapping[str, int]) -> DiagnosticArray:
            message = report.message(live.progress, live.quality, published, last=last)
            message.status += [self._ledger.status(), self._accuracy.status()]
            return message

        message = self._telemetry.diagnose(report_now)
        self._look_for_company()
        if report.verdict != self._verdict:
            self._verdict = report.verdict
            self._log(message.status[0])

    def _look_for_company(self) -> None:
        """Warn once of each that publishes as this twin does: who listens hears both."""
        before, self._company = self._company, self.count_publishers("gearbox_state") - 1
        if self._company > before:
            self.get_logger().warning("gearbox_state has another publisher: a replay, or a twin")

    def _log(self, status: DiagnosticStatus) -> None:
        # A line of its own for each level: rclpy refuses one line with several.
        if status.level == DiagnosticStatus.OK:
            self.get_logger().info(status.message)
        elif status.level == DiagnosticStatus.WARN:
            self.get_logger().warning(status.message)
        else:
            self.get_logger().error(status.message)

    def _new_twin(self) -> pt.Twin:
        try:
            return pt.Twin(self._given.scene_now(), sample_rate=self._given.sample_rate)
        except RunawayError as reason:
            raise ValueError(str(reason)) from None

    def _new_report(self, twin: pt.Twin, begun: Progress) -> RealTimeReport:
        return RealTimeReport(
            self.get_namespace(), self._given.rate_factor, self._given.period, twin.log, begun
        )

    def _running_twin(self) -> pt.Twin:
        if self._twin is None:
            raise NodeError("the model is not built: configure the node first")
        return self._twin


def main(args: list[str] | None = None) -> int:
    """Run the node until it is told to end."""
    sys.setswitchinterval(_SWITCH_INTERVAL)
    return run_node(Simulation, args)


if __name__ == "__main__":
    sys.exit(main())
