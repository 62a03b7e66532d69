"""The logger node: records serialised messages and counts recorded and lost ones by topic."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from functools import partial

from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs.msg import RecorderStatus
from rclpy.duration import Duration
from rclpy.lifecycle import LifecyclePublisher
from rclpy.serialization import serialize_message

from ..base.clock import StrictClock, set_stamp
from ..base.diagnostics import Row, diagnostics
from ..base.lifecycle_node import ManagedNode, NodeError
from ..base.parameters import brief, declare_settings, settings_of
from ..base.services import serve_triggers
from ..base.spin import run_node
from ..process.memory import return_large_blocks
from .diagnostics import RecordingReport, failure_row
from .parameters import LoggerSettings
from .recorder import Recorder, RecorderError

_DISCOVERY_PERIOD = 0.1  # [s]
_STATUS_PERIOD = 1.0  # [s]
_STATUS_MESSAGES = 200  # of a topic, after which a status is due earlier: a fast twin waits for it
_LAST_REPORT = Duration(seconds=1.0)  # longest wait for subscribers to receive it
_OWN = 100  # newest reports of this node, which it does not record


class Logger(ManagedNode):
    """Records while active; cleanup or shutdown finishes the file."""

    # From `configure` on:
    _status_publisher: LifecyclePublisher
    _diagnostics: LifecyclePublisher

    def __init__(self) -> None:
        super().__init__("logger")
        return_large_blocks()
        declare_settings(self, LoggerSettings)
        self._settings = settings_of(self, LoggerSettings)
        self._settings.storage()  # refuses an unknown compression
        self._recorder: Recorder | None = None
        self._own: deque[bytes] = deque(maxlen=_OWN)
        self._status = RecorderStatus()
        self._now = StrictClock(self.get_clock())
        self._report = RecordingReport()
        commands = (Recorder.start, Recorder.stop, Recorder.split, Recorder.snapshot)
        serve_triggers(self, {each.__name__: partial(self._command, each) for each in commands})

    def configure(self) -> None:
        """Create the folder and file of the recording, and the publishers."""
        self._settings = settings_of(self, LoggerSettings)
        self._check_topics()
        recorder = Recorder(
            self, self._settings, self._own, self._on_failure, self._publish_status
        )
        try:
            recorder.begin()
        except RecorderError as refusal:
            raise NodeError(str(refusal)) from None
        except ValueError as refusal:
            raise NodeError(f"name = {refusal}") from None
        self._recorder = recorder
        self._report = RecordingReport()
        self._status_publisher = self.outlet(RecorderStatus, "~/status")
        self._diagnostics = self.outlet(DiagnosticArray, "/diagnostics")

    def activate(self) -> None:
        """Subscribe to existing topics, and to topics that appear later."""
        self.every(_DISCOVERY_PERIOD, self._discover)
        self.every(self._settings.flush_period, self._recording().flush)
        self.every(_STATUS_PERIOD, self._report_status)

    def deactivate(self) -> None:
        """Stop recording; the file stays open, and what it contains is readable."""
        self._recording().pause()

    def close(self) -> None:
        """Finish the file, with the message counts."""
        recorder, self._recorder = self._recorder, None
        if recorder is not None:
            try:
                recorder.close()
            except RecorderError as refusal:
                raise NodeError(str(refusal)) from None

    def _command(self, command: Callable[[Recorder], str]) -> str:
        """Execute a command while the node is active."""
        if self.state != "active":
            raise RecorderError("the logger is not active")
        return command(self._recording())

    def _recording(self) -> Recorder:
        if self._recorder is None:
            raise NodeError("no recording is open: configure the node first")
        return self._recorder

    def _check_topics(self) -> None:
        for name in self._settings.chosen:
            try:
                self.resolve_topic_name(name)
            except RuntimeError as refusal:  # from rcl
                reason = str(refusal).partition(", at ")[0]
                raise NodeError(f"topics: {brief(name)}: {reason}") from None

    def _discover(self) -> None:
        recorder = self._recording()
        new = recorder.discover() or self._status.file != recorder.file
        if new or self._newly_recorded() > _STATUS_MESSAGES:
            self._publish_status()

    def _newly_recorded(self) -> int:
        """Return the number of messages since the last status, of the topic with most of them."""
        before = dict(zip(self._status.topics, self._status.recorded, strict=True))
        accounts = self._recording().matched
        return max((each.recorded - before.get(t, 0) for t, each in accounts.items()), default=0)

    def _on_failure(self, reason: str) -> None:
        self.end_timers()
        self._diagnose(failure_row(reason))
        # A destroyed publisher discards messages that its subscribers have not received yet.
        self._diagnostics.wait_for_all_acked(_LAST_REPORT)
        self.fail(reason)

    def _report_status(self) -> None:
        self._publish_status()
        recorder = self._recording()
        self._diagnose(self._report.row(recorder.file, recorder.size, recorder.matched))

    def _diagnose(self, row: Row) -> None:
        message = diagnostics([row], self.get_namespace())
        set_stamp(message.header.stamp, self._now.now())
        self._own.append(serialize_message(message))
        self._diagnostics.publish(self._own[-1])

    def _publish_status(self) -> None:
        status, recorder = self._status, self._recording()
        accounts = recorder.matched
        set_stamp(status.header.stamp, self._now.now())
        status.sequence += 1
        status.file = recorder.file
        status.duration = recorder.duration
        status.bytes = recorder.size
        status.topics = list(accounts)
        status.recorded = [account.recorded for account in accounts.values()]
        status.lost = [account.lost for account in accounts.values()]
        status.before = [account.lost - account.missed for account in accounts.values()]
        self._status_publisher.publish(status)


def main(args: list[str] | None = None) -> int:
    """Run the node until a signal ends it; returns the exit code."""
    return run_node(Logger, args)
