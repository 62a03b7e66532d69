"""Acts on a running twin as a user does: through its life cycle, its parameters, its topics."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticArray
from lifecycle_msgs.srv import ChangeState, GetState
from planetary_twin_msgs.msg import GearboxState, RecorderStatus
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.client import Client as Service
from rclpy.parameter import Parameter

from ..client import Client
from ..reports import real_time_figures
from ..topics import UNKNOWN_NODE, wanted_topics
from .children import RunError

_NODE = "simulation"
_POLL = 0.1  # [s]
_REPORTED = 3.0  # [s] for which a report, one each second, tells how it is now


class Operator(Client):
    """
    Beside the two nodes of a run.

    What it hears is kept as the newest `state`, `recorder` and real-time `figures`, and as the
    `recordings` there were.
    """

    def __init__(self, namespace: str, watch: Callable[[], None]) -> None:
        super().__init__("operator", namespace, watch)
        self.state: GearboxState | None = None
        self.recorder = RecorderStatus()
        self.recordings: dict[str, None] = {}  # names of their folders, in their order
        self.figures: dict[str, str] = {}
        self._told = 0.0  # [s] when they came
        self._moved = 0.0  # [s] when the newest state came
        listen = self.node.create_subscription
        listen(GearboxState, "gearbox_state", self._hear_state, 10)
        listen(RecorderStatus, "logger/status", self._hear_recorder, 10)
        listen(DiagnosticArray, "/diagnostics", self._hear_diagnostics, 100)
        self._change = self._client(ChangeState, "change_state")
        self._get = self._client(GetState, "get_state")
        self._set = self._client(SetParametersAtomically, "set_parameters_atomically")

    def next_state(self, after: int, seconds: float) -> GearboxState | None:
        """
        Return the newest state whose number is above `after`; None while simulated time stands.

        Raises `RunError` where the twin has failed, or after `seconds` without a state in which
        it runs.
        """
        deadline = time.monotonic() + seconds

        def later() -> bool:
            return self.state is not None and self.state.sequence > after

        while not self.wait(later, _POLL):
            if failure := self.figures.get("failure"):
                raise RunError(f"simulation: {failure}")
            if self.stands():
                return None
            if time.monotonic() > deadline:
                raise RunError(f"simulation: {self._silent(seconds)}")
        return self.state

    def _silent(self, seconds: float) -> str:
        """Say why no state has come for `seconds`."""
        answer = self.call(self._get, GetState.Request())
        label = answer.current_state.label if answer else ""
        if label in ("", "active"):
            return f"publishes no state within {seconds:g} s"
        return f"was made {label} by a request to its life cycle"

    def stands(self) -> str:
        """`paused`, `waits` or nothing, as a report says that came lately and after all states."""
        told = self.figures.get("state", "")
        recent = max(time.monotonic() - _REPORTED, self._moved) < self._told
        return told if recent and told in ("paused", "waits") else ""

    def company(self) -> list[str]:
        """Names of others that publish a twin's state in this namespace."""
        topic = self.node.resolve_topic_name("gearbox_state")
        publishers = self.node.get_publishers_info_by_topic(topic)
        names = [f"{p.node_namespace.rstrip('/')}/{p.node_name}" for p in publishers]
        own = f"{self.namespace.rstrip('/')}/{_NODE}"
        if own in names:
            names.remove(own)
        return [name for name in names if not name.endswith(UNKNOWN_NODE)]

    def bring(self, transition: str, begin: str, goal: str, seconds: float) -> None:
        """Take the simulation through a lifecycle `transition` from state `begin` to `goal`."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            answer = self.call(self._get, GetState.Request())
            if answer is None:
                continue
            label = answer.current_state.label
            if label == goal:
                return
            if label == begin:
                request = ChangeState.Request()
                request.transition.label = transition
                reply = self.call(self._change, request, deadline - time.monotonic())
                if reply is not None and not reply.success:
                    self.watch()
                    raise RunError(f"simulation: refuses to {transition}")
        raise RunError(f"simulation: does not {transition} within {seconds:g} s")

    def set(self, values: Mapping[str, float]) -> None:
        """Set parameters at one instant; raises `RunError` with the reason of a refusal."""
        request = SetParametersAtomically.Request()
        request.parameters = [
            Parameter(name, Parameter.Type.DOUBLE, value).to_parameter_msg()
            for name, value in values.items()
        ]
        for _ in range(3):
            answer = self.call(self._set, request)
            if answer is not None:
                if not answer.result.successful:
                    raise RunError(answer.result.reason)
                return
        raise RunError(f"simulation: no answer to setting {', '.join(values)}")

    def unheard(self) -> str:
        """
        Topics of the simulation that the logger does not hear; empty if it hears them all.

        They are found as the logger finds them: by their names. Which node publishes a topic is
        another message of the middleware, which may never come.
        """
        wanted = wanted_topics(self.node, ())
        topics = {name for name in wanted if self.node.count_publishers(name)}
        if not topics:
            return "the simulation, whose topics are not known"
        return ", ".join(sorted(topics - set(self.recorder.topics)))

    def published(self) -> dict[str, int]:
        """Messages the simulation says it has published, by topic."""
        prefix = "published."
        return {
            key.removeprefix(prefix): int(value)
            for key, value in self.figures.items()
            if key.startswith(prefix)
        }

    def accounted(self) -> dict[str, int]:
        """Messages the logger says it has recorded or missed, by topic."""
        totals = zip(self.recorder.topics, self.recorder.recorded, self.recorder.lost, strict=True)
        return {topic: recorded + lost for topic, recorded, lost in totals}

    def _client(self, kind: type, service: str) -> Service:
        return self.node.create_client(kind, f"{_NODE}/{service}")

    def _hear_state(self, message: GearboxState) -> None:
        self.state, self._moved = message, time.monotonic()

    def _hear_recorder(self, message: RecorderStatus) -> None:
        self.recorder = message
        if message.file:
            self.recordings[Path(message.file).parent.name] = None

    def _hear_diagnostics(self, message: DiagnosticArray) -> None:
        if figures := real_time_figures(message, self.namespace):
            self.figures, self._told = figures, time.monotonic()
