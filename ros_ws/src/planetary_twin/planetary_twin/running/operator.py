"""Controls a running twin as a user does: by its life cycle, its parameters and its topics."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs.msg import GearboxState, RecorderStatus
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.parameter import Parameter

from ..base.diagnostics import real_time_figures
from ..base.topics import UNKNOWN_NODE, wanted_topics
from ..process.memory import return_freed_memory
from .node_process import RunError
from .outcome import Sums
from .run_client import RunClient

NODE = "simulation"
_POLL = 0.1  # [s]
_QUEUED = 1000  # states, 10 s at the default rate
_QUIET = 5.0  # [s] without a state, which is shown
_REPORTED = 3.0  # [s] for which a report, sent once a second, is up to date


class Operator(RunClient):
    """
    The node that controls the two nodes of a run in `namespace`.

    It keeps the newest `state`, the newest status of the `recorder`, the newest real-time
    `figures`, the names of all `recordings`, and the states received are `summed`. `watch` is
    called repeatedly while it waits.
    """

    def __init__(self, namespace: str, watch: Callable[[], None]) -> None:
        super().__init__("operator", namespace, watch)
        self.state: GearboxState | None = None
        self.recordings: dict[str, None] = {}  # names of the folders, in order
        self.figures: dict[str, str] = {}
        self.summed = Sums()
        self._reported = 0.0  # [s] when the figures were received
        self._advanced = 0.0  # [s] when the newest state was received
        self._answered = 0.0  # [s] when a state was last received or expected
        self.node.create_subscription(GearboxState, "gearbox_state", self._on_state, _QUEUED)

    def next_state(self, after: int, seconds: float) -> GearboxState | None:
        """
        Return the newest state whose number exceeds `after`.

        Returns None while simulated time is halted, and after 5 s without a state. Raises
        `RunError` if the twin has failed, or after `seconds` without a state though it runs.
        """
        begin = time.monotonic()
        self._answered = self._answered or begin

        def later() -> bool:
            return self.state is not None and self.state.sequence > after

        while not self.wait(later, _POLL):
            if failure := self.figures.get("failure"):
                raise RunError(f"simulation: {failure}")
            now = time.monotonic()
            if self.halted():
                self._answered = now
                return None
            if now > begin + _QUIET:
                self._check_active()
                if now > self._answered + seconds:
                    raise RunError(f"simulation: publishes no state within {seconds:g} s")
                return None
        self._answered = time.monotonic()
        return self.state

    def _check_active(self) -> None:
        """Raise `RunError` if another client has ended the run by a lifecycle request."""
        label = self.state_of(NODE)
        if label not in ("active", ""):
            raise RunError(f"simulation: is {label} after a lifecycle request")

    def halted(self) -> str:
        """Return `paused` or `waits` if the newest report, after all states, says so, else ''."""
        state = self.figures.get("state", "")
        recent = max(time.monotonic() - _REPORTED, self._advanced) < self._reported
        return state if recent and state in ("paused", "waits") else ""

    def other_publishers(self) -> list[str]:
        """Return the names of other nodes that publish a twin's state in this namespace."""
        topic = self.node.resolve_topic_name("gearbox_state")
        publishers = self.node.get_publishers_info_by_topic(topic)
        names = [f"{p.node_namespace.rstrip('/')}/{p.node_name}" for p in publishers]
        own = f"{self.namespace.rstrip('/')}/{NODE}"
        if own in names:
            names.remove(own)
        return [name for name in names if not name.endswith(UNKNOWN_NODE)]

    def set(self, values: Mapping[str, float]) -> None:
        """Set parameters atomically; raises `RunError` with the reason of a refusal."""
        request = SetParametersAtomically.Request()
        request.parameters = [
            Parameter(name, Parameter.Type.DOUBLE, value).to_parameter_msg()
            for name, value in values.items()
        ]
        for _ in range(3):
            answer = self.call(
                SetParametersAtomically, f"{NODE}/set_parameters_atomically", request
            )
            if answer is not None:
                if not answer.result.successful:
                    raise RunError(answer.result.reason)
                return
        raise RunError(f"simulation: no answer to setting {', '.join(values)}")

    def unsubscribed(self) -> str:
        """
        Return the topics of the simulation to which the logger has not subscribed, or empty.

        Topics are found by name, as the logger does: the node of a publisher arrives in a separate
        discovery message, which may be lost for good.
        """
        wanted = wanted_topics(self.node, ())
        topics = {name for name in wanted if self.node.count_publishers(name)}
        if not topics:
            return "the topics of the simulation, which are unknown"
        return ", ".join(sorted(topics - set(self.recorder.topics)))

    def published(self) -> dict[str, int]:
        """Return the number of messages by topic that the simulation reports as published."""
        prefix = "published."
        return {
            key.removeprefix(prefix): int(value)
            for key, value in self.figures.items()
            if key.startswith(prefix)
        }

    def _on_state(self, message: GearboxState) -> None:
        self.state, self._advanced = message, time.monotonic()
        self.summed.add(partial(getattr, message))

    def on_status(self, message: RecorderStatus) -> None:
        """Receive a status of the logger."""
        super().on_status(message)
        if message.file:
            self.recordings[Path(message.file).parent.name] = None

    def on_diagnostics(self, message: DiagnosticArray) -> None:
        """Receive reports of a node."""
        return_freed_memory()  # once a second
        if figures := real_time_figures(message, self.namespace):
            self.figures, self._reported = figures, time.monotonic()
