"""Subscribes to the topics of a follower and a logger, and deactivates the follower at the end."""

from __future__ import annotations

import time
from collections.abc import Callable

from diagnostic_msgs.msg import DiagnosticArray
from lifecycle_msgs.srv import ChangeState, GetState
from planetary_twin_msgs.msg import FollowerEstimate, FollowerEvent, FollowerTeeth, RecorderStatus
from sensor_msgs.msg import JointState

from planetary_twin_py.recording.ros2.topics import status_name

from ..base.qos import LATCHED
from ..clients.client import Client
from ..follower.diagnostics import CONDITION
from .node_process import RunError

_SETTLED = 0.5  # [s] without a new estimate after which no further one is expected
_TIMEOUT = 10.0  # [s] until the logger has counted the last estimate


class FollowerListener(Client):
    """
    Keeps the newest messages of the follower in `namespace`.

    `watch` is called repeatedly while it waits.
    """

    def __init__(self, namespace: str, watch: Callable[[], None]) -> None:
        super().__init__("follower_listener", namespace, watch)
        self.estimate: FollowerEstimate | None = None
        self.teeth: FollowerTeeth | None = None
        self.events: dict[int, FollowerEvent] = {}
        """Changes by their numbers, as last published."""
        self.begin: float | None = None
        """Stamp of the first reading [s]."""
        self.condition = ""
        """Last report on the condition: what it means that there are no changes."""
        self._report = status_name(f"follower: {CONDITION}", namespace)
        self._recorder = RecorderStatus()
        self._arrived = time.monotonic()
        subscribe = self.node.create_subscription
        subscribe(FollowerEstimate, "follower/estimate", self._on_estimate, 100)
        subscribe(FollowerTeeth, "follower/teeth", self._on_teeth, 100)
        subscribe(FollowerEvent, "follower/event", self._on_event, LATCHED)
        subscribe(RecorderStatus, "logger/status", self._on_status, 10)
        subscribe(DiagnosticArray, "/diagnostics", self._on_diagnostics, 100)
        self._first = subscribe(JointState, "measured/joint_states", self._on_joints, 10)
        self._change = self.node.create_client(ChangeState, "follower/change_state")
        self._get = self.node.create_client(GetState, "follower/get_state")

    def finish(self) -> None:
        """
        Deactivate the follower, and wait until its last estimate is received and recorded.

        Raises `RunError` if it does not respond.
        """
        request = ChangeState.Request()
        request.transition.label = "deactivate"
        while True:
            self.watch()
            answer = self.call(self._change, request, _TIMEOUT)
            state = self.call(self._get, GetState.Request())
            if state is not None and state.current_state.label == "inactive":
                break
            if answer is not None and not answer.success:
                raise RunError("follower: refuses to deactivate")
        self.wait(lambda: time.monotonic() > self._arrived + _SETTLED, _TIMEOUT)
        self.wait(self._recorded, _TIMEOUT)

    def _recorded(self) -> bool:
        """Return whether the logger has counted the last estimate."""
        topic = self.node.resolve_topic_name("follower/estimate")
        counts = dict(zip(self._recorder.topics, self._recorder.recorded, strict=True))
        return self.estimate is None or counts.get(topic, 0) >= self.estimate.sequence

    def _on_estimate(self, message: FollowerEstimate) -> None:
        self.estimate, self._arrived = message, time.monotonic()

    def _on_teeth(self, message: FollowerTeeth) -> None:
        self.teeth = message

    def _on_event(self, message: FollowerEvent) -> None:
        self.events[message.number] = message

    def _on_status(self, message: RecorderStatus) -> None:
        self._recorder = message

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            if status.name == self._report:
                self.condition = status.message

    def _on_joints(self, message: JointState) -> None:
        stamp = message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec
        if self.begin is None or stamp < self.begin:
            self.begin = stamp
