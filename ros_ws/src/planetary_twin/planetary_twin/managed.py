"""What the nodes share: a life cycle that starts by itself, and one way to end."""

from __future__ import annotations

import sys
import threading
import time
import traceback
from collections.abc import Callable, Collection, Mapping
from typing import Any

import rclpy
from lifecycle_msgs.srv import ChangeState
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn

from planetary_twin_py.scene.names import did_you_mean

from .namesakes import Namesakes
from .parameter_node import ParameterNode
from .parameters import brief, declare_at_start
from .signals import SIGNALS
from .standard_error import never_waiting

NAMESPACE = "planetary_twin"
_SOON = 1e-3  # [s]
_QUIET = 1.0  # [s] between two log lines that a client can cause


class NodeError(Exception):
    """A node that cannot do its work; the message says why in one line."""


class ManagedNode(ParameterNode):
    """
    Lifecycle node that configures and activates itself unless `autostart` is false.

    `given` are parameters as from the command line. Subclasses override `configure`, `activate`,
    `deactivate` and `close`; what these raise is logged and fails the transition, where rclpy
    alone would swallow it.
    """

    def __init__(self, name: str, given: Mapping[str, Any] | None = None) -> None:
        super().__init__(name, NAMESPACE, given or {})
        self.failure: str | None = None
        """Why the process ends, if it is no good end."""
        self._reason = ""
        self._broken = ""
        self._starting = False
        service = self.service_of(ChangeState)
        self._change_state, service.callback = service.callback, self._change_state_if_possible
        self._autostart = bool(
            declare_at_start(self, "autostart", True, "configure and activate without being asked")
        )
        self._namesakes = Namesakes(self)

    def configure(self) -> None:
        """Acquire what running needs."""

    def activate(self) -> None:
        """Begin."""

    def deactivate(self) -> None:
        """Pause."""

    def close(self) -> None:
        """Let go of everything; called more than once."""

    def start(self) -> None:
        """Go as far as the parameters say; raises `NodeError` where a step fails."""
        if not self._autostart:
            self.get_logger().info("unconfigured, for autostart is false: waits for transitions")
            return
        self._starting = True
        for trigger in (self.trigger_configure, self.trigger_activate):
            if trigger() != TransitionCallbackReturn.SUCCESS:
                if not self.context.ok():
                    raise ExternalShutdownException
                raise NodeError(self._reason)
        self._starting = False

    def fail(self, reason: str) -> None:
        """
        From any thread: let an active node go to the error state.

        One that has started by itself has nobody to mend it: its process ends, with an exit code
        that is not zero.
        """
        if self._autostart:
            self.failure = reason
            rclpy.try_shutdown(context=self.context)
        else:
            self.executor.create_task(self._break_down, reason)

    def _break_down(self, reason: str) -> None:
        if self.state == "active":
            self._broken = reason
            self.trigger_deactivate()  # the only way from there to the error state

    # Lifecycle publishers send from the beginning of `activate` to the end of `deactivate`.

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Lifecycle transition."""
        with SIGNALS.interrupting():  # it may take long, and has nothing to lose
            outcome = self._attempt(self.configure)
        if outcome == TransitionCallbackReturn.FAILURE:
            self.close()
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
        if not self._broken:
            outcome = self._attempt(self.deactivate)
            super().on_deactivate(state)
            return outcome
        self.get_logger().error(self._broken)
        self._broken = ""
        return TransitionCallbackReturn.ERROR

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Lifecycle transition."""
        return self._attempt(self.close)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Lifecycle transition."""
        return self._attempt(self.close)

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Let go of what is left, so that the node can be configured again."""
        return self._attempt(self.close)

    def _change_state_if_possible(
        self, request: ChangeState.Request, response: ChangeState.Response
    ) -> ChangeState.Response:
        """Rclpy's service, which raises for what is no transition of the present state."""
        wanted = request.transition.label or request.transition.id
        offered = self.transitions()
        if any(wanted in transition for transition in offered.items()):
            return self._change_state(request, response)
        known = ", ".join(offered.values()) or "none"
        self.get_logger().warning(
            f"{brief(wanted)}: no transition of the state {self.state}; there are: {known}",
            throttle_duration_sec=_QUIET,
        )
        response.success = False
        return response

    def _attempt(self, step: Callable[[], None]) -> TransitionCallbackReturn:
        try:
            step()
        except (NodeError, ValueError, OSError) as reason:
            self._reason = str(reason)
            if not self._starting:  # else it is the last line the process prints
                self.get_logger().error(self._reason)
            return TransitionCallbackReturn.FAILURE
        except Exception as defect:
            if not self.context.ok():  # a signal has shut ROS down meanwhile
                return TransitionCallbackReturn.FAILURE
            self._reason = f"{type(defect).__name__}: {defect}"
            self.get_logger().error(traceback.format_exc())
            return TransitionCallbackReturn.ERROR
        return TransitionCallbackReturn.SUCCESS


def run_node(
    make: Callable[[], ManagedNode], args: list[str] | None = None, title: str | None = None
) -> int:
    """
    Run a node until SIGINT, SIGTERM or its own end; returns the exit code.

    Why it failed is printed in one line that begins with `title`, by default the node's class.
    """
    return run_nodes({title or make.__name__.lower(): make}, args)


def run_nodes(
    makes: Mapping[str, Callable[[], ManagedNode]], args: list[str] | None = None
) -> int:
    """
    Start nodes in this order and run them until SIGINT, SIGTERM or the end of one of them.

    Each has an executor and a thread of its own, the last of them this one, so that none waits for
    another's callbacks. Why one failed is printed in one line that begins with its key.
    """
    with never_waiting():
        failures = _run_to_end(makes, args)
    for name, failure in failures.items():
        print(f"{name}: {failure}", file=sys.stderr)
    return 1 if failures else 0


def _run_to_end(
    makes: Mapping[str, Callable[[], ManagedNode]], args: list[str] | None
) -> dict[str, str]:
    """Return why nodes failed, by their keys."""
    nodes: dict[str, ManagedNode] = {}
    executors: list[SingleThreadedExecutor] = []  # which outlive what a signal still does to them
    beside: list[threading.Thread] = []
    failures: dict[str, str] = {}
    name, *_ = makes
    SIGNALS.listen()
    waker = threading.Thread(target=wake_after_shutdown, args=[executors], name="waker")
    waker.start()
    try:
        with SIGNALS.interrupting():
            _initialize(args)
        for name, make in makes.items():
            with SIGNALS.interrupting():
                nodes[name] = node = _made(make)
            node.start()
            executors.append(SingleThreadedExecutor())
            executors[-1].add_node(node)
            if len(nodes) < len(makes):
                given = [executors[-1], node]
                beside.append(threading.Thread(target=_serve_beside, args=given, name=name))
                beside[-1].start()
        _warn_of_unknown(nodes.values())
        executors[-1].spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except (NodeError, ParameterException, ValueError, OSError) as reason:
        failures[name] = str(reason)
    except RuntimeError:  # of rcl
        # A callback that publishes while a signal shuts ROS down is refused: that is the end.
        if rclpy.ok():
            raise
    finally:
        if rclpy.ok():  # else rclpy's signal thread is at it, and must not be met there
            rclpy.try_shutdown()
        SIGNALS.told.set()
        for thread in (waker, *beside):
            thread.join()
        for name, node in nodes.items():
            if failure := _end(node):
                failures[name] = failure
        rclpy.try_shutdown()
        SIGNALS.ignore()
    return failures


def wake_after_shutdown(executors: list[SingleThreadedExecutor]) -> None:
    """
    Wait for a signal, and wake what spins once ROS is shut down.

    rclpy wakes executors first and shuts ROS down then: one that is quick sees ROS still running,
    and waits on, for nothing.
    """
    SIGNALS.told.wait()
    while rclpy.ok():
        time.sleep(_SOON)
    for executor in list(executors):
        executor.wake()


def _warn_of_unknown(nodes: Collection[ManagedNode]) -> None:
    """Tell of parameters given at the start that no node here has: ROS ignores them silently."""
    known = [name for node in nodes for name in node.get_parameters_by_prefix("")]
    unknown = {name: node for node in nodes for name in node.given}
    for name, node in sorted(unknown.items(), key=lambda item: item[0]):
        if name not in known:
            near = did_you_mean(name, known)
            node.get_logger().warning(f"{name}: no such parameter{near}")


def _serve_beside(executor: SingleThreadedExecutor, node: ManagedNode) -> None:
    """Answer `node`'s callbacks in a thread beside the main one; a defect ends the process."""
    try:
        executor.spin()
    except ExternalShutdownException:
        pass
    except Exception as defect:
        if rclpy.ok():  # else the callback was refused because ROS has been shut down
            node.get_logger().error(traceback.format_exc())
            node.failure = f"{type(defect).__name__}: {defect}"
            rclpy.try_shutdown()


def _initialize(args: list[str] | None) -> None:
    try:
        rclpy.init(args=args)
    except RuntimeError as refusal:  # of rcl, and what rclpy derives for options it does not know
        raise NodeError(f"--ros-args: {str(refusal).split(', at ')[0]}") from None


def _made(make: Callable[[], ManagedNode]) -> ManagedNode:
    try:
        return make()
    except RuntimeError as refusal:  # of rcl
        if not rclpy.ok():  # a signal came between
            raise
        reason = " ".join(str(refusal).split(", at ")[0].split())
        raise NodeError(f"the middleware refuses the node: {reason}") from None


def _end(node: ManagedNode) -> str | None:
    """Close and destroy `node`; returns why it failed, if it did."""
    try:
        node.close()
    except (NodeError, OSError) as reason:
        node.failure = node.failure or str(reason)
    node.destroy_node()
    return node.failure
