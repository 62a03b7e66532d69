"""Acts on a running twin as a user does: through its life cycle, its parameters, its topics."""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable, Mapping
from types import TracebackType
from typing import Any, Self

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from lifecycle_msgs.srv import ChangeState, GetState
from planetary_twin_msgs.msg import GearboxState, RecorderStatus
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.client import Client
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions

from .children import RunError

_PATIENCE = 2.0  # [s] the answer to a first call after discovery may get lost: ask again
_POLL = 0.02  # [s]
_NODE = "simulation"
_MACHINERY = ("/rosout", "/parameter_events")


class Operator:
    """A ROS node of its own beside the twin's two; `watch` is called while it waits.

    What it hears is kept as the newest `state`, `recorder` and real-time `figures`.
    """

    def __init__(self, namespace: str, watch: Callable[[], None]) -> None:
        self._watch = watch
        self._context = rclpy.Context()
        # Signals stay Python's: they interrupt the waiting below, never a middleware call.
        rclpy.init(context=self._context, signal_handler_options=SignalHandlerOptions.NO)
        self._node = rclpy.create_node("operator", namespace=namespace, context=self._context)
        self._namespace = self._node.get_namespace()
        self.state: GearboxState | None = None
        self.recorder = RecorderStatus()
        self.figures: dict[str, str] = {}
        listen = self._node.create_subscription
        listen(GearboxState, "gearbox_state", self._hear_state, 10)
        listen(RecorderStatus, "logger/status", self._hear_recorder, 10)
        listen(DiagnosticArray, "/diagnostics", self._hear_diagnostics, 100)
        self._change = self._client(ChangeState, "change_state")
        self._get = self._client(GetState, "get_state")
        self._set = self._client(SetParametersAtomically, "set_parameters_atomically")
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._thread = threading.Thread(target=self._spin, name="operator", daemon=True)
        self._thread.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        value: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._context.try_shutdown()
        self._thread.join()
        self._node.destroy_node()

    def wait(self, what: str, ready: Callable[[], bool], seconds: float) -> None:
        """Return as soon as `ready`; raises `RunError` naming `what` after `seconds`."""
        if not self.wait_or_go_on(ready, seconds):
            raise RunError(f"{what}: not within {seconds:g} s")

    def wait_or_go_on(self, ready: Callable[[], bool], seconds: float) -> bool:
        """As `wait`, but returns whether it came."""
        deadline = time.monotonic() + seconds
        while not ready():
            if time.monotonic() > deadline:
                return False
            self._watch()
            time.sleep(_POLL)
        return True

    def next_state(self, after: float, seconds: float) -> GearboxState:
        """The newest state later than simulated time `after` [s], within `seconds`."""
        newest: list[GearboxState] = []

        def heard() -> bool:
            newest[:] = [self.state] if self.state is not None else []
            return bool(newest) and newest[0].simulated_time > after

        self.wait("simulation: publishes its state", heard, seconds)
        return newest[0]

    def twins(self) -> int:
        """Simulations in this namespace, this run's own included."""
        return self._node.get_node_names_and_namespaces().count((_NODE, self._namespace))

    def bring(self, transition: str, begin: str, goal: str, seconds: float) -> None:
        """Take the simulation through a lifecycle `transition` from state `begin` to `goal`."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            answer = self._call(self._get, GetState.Request())
            if answer is None:
                continue
            label = answer.current_state.label
            if label == goal:
                return
            if label == begin:
                request = ChangeState.Request()
                request.transition.label = transition
                reply = self._call(self._change, request, deadline - time.monotonic())
                if reply is not None and not reply.success:
                    self._watch()
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
            answer = self._call(self._set, request)
            if answer is not None:
                if not answer.result.successful:
                    raise RunError(answer.result.reason)
                return
        raise RunError(f"simulation: no answer to setting {', '.join(values)}")

    def topics(self) -> set[str]:
        """Topics the simulation publishes, without those of ROS itself."""
        try:
            found = self._node.get_publisher_names_and_types_by_node(_NODE, self._namespace)
        except rclpy.node.NodeNameNonExistentError:
            return set()
        names = {name for name, _ in found}
        return {n for n in names if n not in _MACHINERY and not n.endswith("/transition_event")}

    def published(self) -> dict[str, int]:
        """Messages the simulation says it has published, by topic."""
        prefix = "published."
        return {
            key.removeprefix(prefix): int(value)
            for key, value in self.figures.items()
            if key.startswith(prefix)
        }

    def _client(self, kind: type, service: str) -> Client:
        return self._node.create_client(kind, f"{_NODE}/{service}")

    def _call(self, client: Client, request: Any, patience: float = _PATIENCE) -> Any:
        """The answer, or None where there is none in time."""
        if not self.wait_or_go_on(client.service_is_ready, patience):
            return None
        future = client.call_async(request)
        if self.wait_or_go_on(future.done, patience):
            return future.result()
        client.remove_pending_request(future)
        return None

    def _spin(self) -> None:
        with contextlib.suppress(ExternalShutdownException):
            self._executor.spin()

    def _hear_state(self, message: GearboxState) -> None:
        self.state = message

    def _hear_recorder(self, message: RecorderStatus) -> None:
        self.recorder = message

    def _hear_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            if status.name == f"{_NODE}: real time" and status.hardware_id == self._namespace:
                self.figures = {item.key: item.value for item in status.values}
