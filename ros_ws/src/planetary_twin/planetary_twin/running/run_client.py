"""What a run of any kind does with its nodes: transitions, and what the logger has recorded."""

from __future__ import annotations

import time
from collections.abc import Callable

from diagnostic_msgs.msg import DiagnosticArray
from lifecycle_msgs.srv import ChangeState, GetState
from planetary_twin_msgs.msg import RecorderStatus

from ..clients.client import Client
from .node_process import RunError

_REPEAT = 10.0  # [s] then ask again: the response may have been lost


class RunClient(Client):
    """Keeps the newest status of the logger, see `Client`."""

    def __init__(self, name: str, namespace: str, watch: Callable[[], None]) -> None:
        super().__init__(name, namespace, watch)
        self.recorder = RecorderStatus()
        self.node.create_subscription(RecorderStatus, "logger/status", self.on_status, 10)
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self.on_diagnostics, 100)

    def on_status(self, message: RecorderStatus) -> None:
        """Receive a status of the logger."""
        self.recorder = message

    def on_diagnostics(self, message: DiagnosticArray) -> None:
        """Receive reports of a node."""

    def accounted(self) -> dict[str, int]:
        """Return the number of messages by topic that the logger reports as recorded or lost."""
        totals = zip(self.recorder.topics, self.recorder.recorded, self.recorder.lost, strict=True)
        return {topic: recorded + lost for topic, recorded, lost in totals}

    def state_of(self, node: str) -> str:
        """Return the lifecycle state of `node`, or an empty text if it does not answer."""
        answer = self.call(GetState, f"{node}/get_state", GetState.Request())
        return str(answer.current_state.label) if answer else ""

    def change_state(
        self, node: str, transition: str, begin: str, goal: str, seconds: float
    ) -> None:
        """
        Make `node` execute a lifecycle `transition` from state `begin` to state `goal`.

        Raises `RunError` if it refuses, or after `seconds`.
        """
        request = ChangeState.Request()
        request.transition.label = transition
        deadline = time.monotonic() + seconds
        while (left := deadline - time.monotonic()) > 0.0:
            label = self.state_of(node)
            if label == goal:
                return
            if label == begin:
                service = f"{node}/change_state"
                answer = self.call(ChangeState, service, request, min(left, _REPEAT))
                if answer is not None and not answer.success:
                    self.watch()
                    raise RunError(f"{node}: refuses to {transition}")
        raise RunError(f"{node}: does not {transition} within {seconds:g} s")
