"""Runs nodes until a signal or their own end, and ends them in order."""

from __future__ import annotations

import sys
import threading
import traceback
from collections.abc import Callable, Collection, Mapping

import rclpy
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

from planetary_twin_py.scene.names import did_you_mean

from ..process.environment import choose_log_folder
from ..process.signals import SIGNALS
from ..process.standard_error import nonblocking_stderr
from .lifecycle_node import ManagedNode, NodeError, shut_down


def run_node(
    make: Callable[[], ManagedNode],
    args: list[str] | None = None,
    title: str | None = None,
    refusal: int = 1,
) -> int:
    """
    Run the node that `make` creates until SIGINT, SIGTERM or its own end.

    `args` are command-line arguments, by default those of the process. The reason of a failure is
    printed in one line after `title`, by default the name of the class. Returns the exit code,
    which is `refusal` if the node does not start.
    """
    return run_nodes({title or make.__name__.lower(): make}, args, refusal)


def run_nodes(
    makes: Mapping[str, Callable[[], ManagedNode]],
    args: list[str] | None = None,
    refusal: int = 1,
) -> int:
    """
    Start the nodes that `makes` create, in order, and run them until a signal or one of them ends.

    Each node has its own executor and thread, so that none waits for another's callbacks; the last
    node runs in this thread. `args` are command-line arguments, by default those of the process.
    The reason of a failure is printed in one line after the node's key. Returns the exit code,
    which is `refusal` if a node does not start.
    """
    with nonblocking_stderr():
        refusals, failures = _run_to_end(makes, args)
    for name, failure in (refusals | failures).items():
        print(f"{name}: {failure}", file=sys.stderr)
    return refusal if refusals else 1 if failures else 0


def _run_to_end(
    makes: Mapping[str, Callable[[], ManagedNode]], args: list[str] | None
) -> tuple[dict[str, str], dict[str, str]]:
    """Return why nodes did not start, and why they failed later, by their keys."""
    nodes: dict[str, ManagedNode] = {}
    executors: list[SingleThreadedExecutor] = []  # kept: a signal may still wake one of them
    beside: list[threading.Thread] = []
    refusals: dict[str, str] = {}
    failures: dict[str, str] = {}
    name, *_ = makes
    SIGNALS.install()
    try:
        with SIGNALS.interrupting():
            _initialize(args)
        for name, make in makes.items():
            with SIGNALS.interrupting():
                nodes[name] = node = _create(make)
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
        refusals[name] = str(reason)
    except RuntimeError:  # from rcl
        # rcl refuses to publish while a signal shuts down ROS: a normal end.
        if rclpy.ok():
            raise
    finally:
        shut_down()
        for thread in beside:
            thread.join()
        for name, node in nodes.items():
            if failure := _end(node):
                failures[name] = failure
        shut_down()
        SIGNALS.ignore()
    return refusals, failures


def _warn_of_unknown(nodes: Collection[ManagedNode]) -> None:
    """Warn of start values for parameters that no node here has: ROS ignores them silently."""
    known = [name for node in nodes for name in node.get_parameters_by_prefix("")]
    unknown = {name: node for node in nodes for name in node.given}
    for name, node in sorted(unknown.items(), key=lambda item: item[0]):
        if name not in known:
            near = did_you_mean(name, known)
            node.get_logger().warning(f"{name}: no such parameter{near}")


def _serve_beside(executor: SingleThreadedExecutor, node: ManagedNode) -> None:
    """Execute `node`'s callbacks in a second thread; an exception ends the process."""
    try:
        executor.spin()
    except ExternalShutdownException:
        pass
    except Exception as defect:
        if rclpy.ok():  # otherwise rcl refused the callback because ROS has been shut down
            node.get_logger().error(traceback.format_exc())
            node.failure = f"{type(defect).__name__}: {defect}"
            shut_down()


def _initialize(args: list[str] | None) -> None:
    choose_log_folder()
    try:
        rclpy.init(args=args)
    except RuntimeError as refusal:  # from rcl, or from rclpy for unknown options
        raise NodeError(f"--ros-args: {str(refusal).split(', at ')[0]}") from None


def _create(make: Callable[[], ManagedNode]) -> ManagedNode:
    try:
        return make()
    except RuntimeError as refusal:  # from rcl
        if not rclpy.ok():  # a signal has shut down ROS
            raise
        reason = " ".join(str(refusal).split(", at ")[0].split())
        raise NodeError(f"the middleware refuses the node: {reason}") from None


def _end(node: ManagedNode) -> str | None:
    """Close and destroy `node`; returns the reason if it failed."""
    try:
        node.close()
    except (NodeError, OSError) as reason:
        node.failure = node.failure or str(reason)
    node.destroy_node()
    return node.failure
