"""What the nodes share: a life cycle that starts by itself, and one way to end."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable, Mapping
from typing import Any

import rclpy
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.parameter import Parameter

from .parameters import declare_fixed

NAMESPACE = "planetary_twin"
RCLError = rclpy_implementation.RCLError


class NodeError(Exception):
    """A node that cannot do its work; the message says why in one line."""


class ManagedNode(LifecycleNode):
    """Lifecycle node that configures and activates itself unless `autostart` is false.

    `given` are parameters as from the command line. Subclasses override `configure`, `activate`,
    `deactivate` and `close`; what these raise is logged and fails the transition, where rclpy alone
    would swallow it.
    """

    def __init__(self, name: str, given: Mapping[str, Any] | None = None) -> None:
        overrides = [Parameter(key, value=value) for key, value in (given or {}).items()]
        super().__init__(name, namespace=NAMESPACE, parameter_overrides=overrides)
        self.failure: str | None = None
        self._starting = False
        self._autostart = bool(
            declare_fixed(self, "autostart", True, "configure and activate without being asked")
        )

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
            return
        self._starting = True
        for trigger in (self.trigger_configure, self.trigger_activate):
            if trigger() != TransitionCallbackReturn.SUCCESS:
                raise NodeError(self.failure or "cannot start")
        self._starting = False

    def fail(self, reason: str) -> None:
        """End the process from any thread: what spins returns, and the exit code is not zero."""
        self.failure = reason
        rclpy.try_shutdown(context=self.context)

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Lifecycle transition."""
        return self._attempt(self.configure)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Lifecycle transition."""
        return self._attempt(self.activate)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Lifecycle transition."""
        return self._attempt(self.deactivate)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Lifecycle transition."""
        return self._attempt(self.close)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Lifecycle transition."""
        return self._attempt(self.close)

    def _attempt(self, step: Callable[[], None]) -> TransitionCallbackReturn:
        try:
            step()
        except (NodeError, ValueError, OSError) as reason:
            self.failure = str(reason)
            if not self._starting:  # else it is the last line the process prints
                self.get_logger().error(self.failure)
            return TransitionCallbackReturn.FAILURE
        except Exception as defect:
            self.failure = f"{type(defect).__name__}: {defect}"
            self.get_logger().error(traceback.format_exc())
            return TransitionCallbackReturn.ERROR
        return TransitionCallbackReturn.SUCCESS


def run_node(
    make: Callable[[], ManagedNode], args: list[str] | None = None, title: str | None = None
) -> int:
    """Run a node until SIGINT, SIGTERM or its own end; returns the exit code.

    Why it failed is printed in one line that begins with `title`, by default the node's class.
    """
    node: ManagedNode | None = None
    failure: str | None = None
    try:
        rclpy.init(args=args)
        node = make()
        node.start()
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except (NodeError, ParameterException, ValueError, OSError) as reason:
        failure = str(reason)
    except RCLError:
        # A callback that publishes while a signal shuts ROS down is refused: that is the end.
        if rclpy.ok():
            raise
    finally:
        failure = _end(node) or failure
        rclpy.try_shutdown()
    if failure:
        print(f"{title or make.__name__.lower()}: {failure}", file=sys.stderr)
    return 1 if failure else 0


def _end(node: ManagedNode | None) -> str | None:
    """Close and destroy `node`; returns why it failed, if it did."""
    if node is None:
        return None
    try:
        node.close()
    except OSError as reason:
        node.failure = node.failure or str(reason)
    node.destroy_node()
    return node.failure
