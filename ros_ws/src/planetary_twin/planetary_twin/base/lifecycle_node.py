"""Base of the nodes: a life cycle that starts automatically."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from typing import Any, Protocol, TypeVar

import rclpy
from lifecycle_msgs.srv import ChangeState
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException
from rclpy.lifecycle import LifecyclePublisher, LifecycleState, TransitionCallbackReturn
from rclpy.qos import QoSProfile
from rclpy.timer import Timer

from ..process.memory import return_freed_memory
from ..process.signals import SIGNALS
from .clock import STEADY
from .parameter_node import ParameterNode
from .parameters import AT_START, brief, declare

NAMESPACE = "planetary_twin"
_LOG_PERIOD = 1.0  # [s] between two log lines that a client can cause
_NAMES_PERIOD = 60.0  # [s] discovery on a busy machine may lose a node and find it again
_CARE_PERIOD = 1.0  # [s] between two returns of freed memory, and two looks at other nodes


def shut_down(context: Context | None = None) -> None:
    """
    Shut `context`, or the default one of rclpy, down unless it is already shut down.

    Raises `RuntimeError` if rcl fails and the context is still valid.
    """
    try:
        rclpy.try_shutdown(context=context)
    except RuntimeError:
        # rclpy's signal thread may shut down between the check of rclpy and its call of rcl
        # (ros2/rclpy#1352, open in Jazzy; tests/ros/process/test_shutdown.py).
        if rclpy.ok(context=context):
            raise


class Closed(Protocol):
    """What a node opens and closes."""

    def close(self) -> None:
        """Release it."""


Resource = TypeVar("Resource", bound=Closed)


class NodeError(Exception):
    """A node cannot work; the message gives the reason in one line."""


class ManagedNode(ParameterNode):
    """
    Lifecycle node that configures and activates itself unless `autostart` is false.

    `given` contains start values of parameters, as from the command line. Subclasses override
    `configure`, `activate`, `deactivate` and `close`. An exception in one of these is logged and
    fails the transition; rclpy alone would discard it. The timers of `every` end with the work of
    the node; the publishers of `outlet` and what `opened` got end when the node is cleaned up.
    """

    def __init__(self, name: str, given: Mapping[str, Any] | None = None) -> None:
        super().__init__(name, NAMESPACE, given or {})
        self.failure: str | None = None
        """Reason why the process ends with an error; None without one."""
        self._reason = ""
        self._broken = ""
        self._starting = False
        self._opened = ExitStack()
        self._ticking: list[Timer] = []
        service = self.service_of(ChangeState)
        self._change_state, service.callback = service.callback, self._change_state_if_possible
        self._autostart = bool(
            declare(self, "autostart", True, "configure and activate at the start", when=AT_START)
        )
        self._namesakes = 0
        # It also wakes an executor that rclpy woke before it shut down ROS (test_waking.py).
        self.create_timer(_CARE_PERIOD, self._take_care, clock=STEADY)

    def configure(self) -> None:
        """Acquire the resources of a run."""

    def activate(self) -> None:
        """Start the work of the node."""

    def deactivate(self) -> None:
        """Pause the work of the node."""

    def close(self) -> None:
        """Release the other resources; may be called more than once."""

    def start(self) -> None:
        """Configure and activate if `autostart` is true; raises `NodeError` if that fails."""
        if not self._autostart:
            self.get_logger().info("autostart is false: the node waits for transitions")
            return
        self._starting = True
        for trigger in (self.trigger_configure, self.trigger_activate):
            if trigger() != TransitionCallbackReturn.SUCCESS:
                if not self.context.ok():
                    raise ExternalShutdownException
                raise NodeError(self._reason)
        self._starting = False

    def outlet(self, kind: type, topic: str, qos: QoSProfile | int = 10) -> LifecyclePublisher:
        """Create a publisher for the time until the node is cleaned up."""
        publisher = self.create_lifecycle_publisher(kind, topic, qos)
        self._opened.callback(self.destroy_lifecycle_publisher, publisher)
        return publisher

    def opened(self, resource: Resource) -> Resource:
        """Return `resource`, which is closed when the node is cleaned up."""
        self._opened.callback(resource.close)
        return resource

    def every(self, period: float, work: Callable[[], None]) -> None:
        """Call `work` every `period` [s] of the steady clock, until the node is deactivated."""
        self._ticking.append(self.create_timer(period, work, clock=STEADY))

    def end_timers(self) -> None:
        """End the timers of `every`."""
        while self._ticking:
            self.destroy_timer(self._ticking.pop())

    def broke(self, work: str, defect: Exception) -> None:
        """Fail because `defect` ended `work`, unless a signal has shut down ROS."""
        if not self.context.ok():
            return
        if not isinstance(defect, (ValueError, ArithmeticError)):
            self.get_logger().error("".join(traceback.format_exception(defect)))
        self.fail(f"{work} stopped: {defect}")

    def fail(self, reason: str) -> None:
        """
        Move an active node to the error state; may be called from any thread.

        If the node started automatically, no manager can recover it: its process ends with a
        non-zero exit code.
        """
        if self._autostart:
            self.failure = reason
            shut_down(self.context)
        elif self.executor is not None:  # a node that nothing runs cannot change its state
            self.executor.create_task(self._break_down, reason)

    def _break_down(self, reason: str) -> None:
        if self.state == "active":
            self._broken = reason
            self.trigger_deactivate()  # the only transition that leads to the error state

    # Lifecycle publishers are enabled from the start of `activate` to the end of `deactivate`.

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Lifecycle transition."""
        with SIGNALS.interrupting():  # it may take long, and there is no data to save
            outcome = self._attempt(self.configure)
        if outcome == TransitionCallbackReturn.FAILURE:
            self._release()
        return outcome

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Lifecycle transition."""
        super().on_activate(state)
        outcome = self._attempt(self.activate)
        if outcome != TransitionCallbackReturn.SUCCESS:
            super().on_deactivate(state)
        return outcome

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Lifecycle transition."""
        self.end_timers()
        if not self._broken:
            outcome = self._attempt(self.deactivate)
            super().on_deactivate(state)
            return outcome
        self.get_logger().error(self._broken)
        self._broken = ""
        return TransitionCallbackReturn.ERROR

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Release all resources, so that the node can be configured again."""
        return self._attempt(self._release)

    on_shutdown = on_error = on_cleanup

    def _release(self) -> None:
        self.end_timers()
        with self._opened:
            self.close()

    def _take_care(self) -> None:
        """Return freed memory, and warn of another node with the same name: both would answer."""
        return_freed_memory()
        own = (self.get_name(), self.get_namespace())
        known = self.get_node_names_and_namespaces().count(own)
        before, self._namesakes = self._namesakes, max(known - 1, 0)  # it may discover itself late
        if self._namesakes > before:
            self.get_logger().warning(
                f"another node is named {self.get_fully_qualified_name()}: either may answer a "
                "service, and both publish on its topics; give each a namespace, -r __ns:=/NAME",
                throttle_duration_sec=_NAMES_PERIOD,
            )

    def _change_state_if_possible(
        self, request: ChangeState.Request, response: ChangeState.Response
    ) -> ChangeState.Response:
        """
        Call rclpy's service, which raises for transitions that the present state lacks.

        That would end the node (ros2/rclpy#1209, open in Jazzy; tests/ros/base/test_lifecycle.py).
        """
        wanted = request.transition.label or request.transition.id
        offered = self.transitions()
        if any(wanted in transition for transition in offered.items()):
            return self._change_state(request, response)
        known = ", ".join(offered.values()) or "none"
        self.get_logger().warning(
            f"{brief(wanted)}: no transition of the state {self.state}; there are: {known}",
            throttle_duration_sec=_LOG_PERIOD,
        )
        response.success = False
        return response

    def _attempt(self, step: Callable[[], None]) -> TransitionCallbackReturn:
        try:
            step()
        except (NodeError, ValueError, OSError) as reason:
            self._reason = str(reason)
            if not self._starting:  # otherwise it is the last line that the process prints
                self.get_logger().error(self._reason)
            return TransitionCallbackReturn.FAILURE
        except Exception as defect:
            if not self.context.ok():  # a signal has shut down ROS
                return TransitionCallbackReturn.FAILURE
            self._reason = f"{type(defect).__name__}: {defect}"
            self.get_logger().error(traceback.format_exc())
            return TransitionCallbackReturn.ERROR
        return TransitionCallbackReturn.SUCCESS
