"""Waits for the subscriptions of a node, so that it receives the first message of a twin."""

from __future__ import annotations

import time

from diagnostic_msgs.msg import DiagnosticStatus
from rclpy.node import Node
from rclpy.publisher import Publisher

from .diagnostics import Row
from .topics import UNKNOWN_NODE, is_of_twin

RECORDER = "simulation: recorder"
TIMEOUT = 10.0  # [s]
_SETTLED = 3.0  # [s] without a new subscription, after which no more are expected
_POLL = 0.05  # [s]


class SubscriptionWait:
    """
    Reports whether the node `name` has subscribed to `node`'s topics.

    A name that does not start with a slash is relative to the namespace of `node`.

    A node that has subscribed to every topic of the twin is present at once. One that subscribes
    to some of them is present after three seconds without a further subscription: nodes that start
    together discover each other after some tenths of a second, or after three seconds if a
    discovery message of the middleware is lost. The name of a subscription's node arrives in a
    separate message, which may be lost for good: after that time, a subscription of an unknown
    node counts as one of `name`. If `name` is empty, there is nothing to wait for.
    """

    def __init__(self, node: Node, name: str) -> None:
        self._node = node
        self._name = name
        self._present = not name
        self._since = 0.0
        self._checked = 0.0
        self._changed = 0.0
        self._subscribed = (0, 0)

    def begin(self) -> None:
        """Start the timeout."""
        self._since = time.monotonic()
        if not self._present:
            self._node.get_logger().info(
                f"wait_for = {self._name}: waits until it has subscribed, {TIMEOUT:g} s at most"
            )

    def present(self) -> bool:
        """Return whether the node has subscribed, or the timeout has expired."""
        now = time.monotonic()
        if self._present or now < self._checked + _POLL:
            return self._present
        self._checked = now
        before, self._subscribed = self._subscribed, self._subscriptions()
        if self._subscribed != before:
            self._changed = now
        named, unnamed = self._subscribed
        settled = now - self._changed > _SETTLED
        self._present = named >= len(self._published()) or (named + unnamed > 0 and settled)
        if not self._present and now > self._since + TIMEOUT:
            self._present = True
            self._node.get_logger().warning(
                f"wait_for = {self._name}: has not subscribed within {TIMEOUT:g} s; "
                "starts without it"
            )
        return self._present

    def row(self) -> Row:
        """
        Return the report on the node that the twin has waited for.

        A node that was killed counts as present until the middleware forgets its process.
        """
        missing = self._present and self._subscriptions() == (0, 0)
        text = "does not subscribe: nothing is recorded by it" if missing else "subscribes"
        level = DiagnosticStatus.ERROR if missing else DiagnosticStatus.OK
        return Row(RECORDER, level, f"{self._name} {text}")

    def _published(self) -> list[Publisher]:
        """Return the publishers of the twin's own topics."""
        namespace = self._node.get_namespace()
        return [one for one in self._node.publishers if is_of_twin(one.topic_name, namespace)]

    def _subscriptions(self) -> tuple[int, int]:
        """Count the matched topics of `node` to which `name`, or an unknown node, subscribes."""
        wanted = full_name(self._node.get_namespace(), self._name)
        named = unnamed = 0
        for publisher in self._published():
            if not publisher.get_subscription_count():
                continue
            subscribers = self._node.get_subscriptions_info_by_topic(publisher.topic_name)
            named += any(
                full_name(one.node_namespace, one.node_name) == wanted for one in subscribers
            )
            unnamed += any(one.node_name == UNKNOWN_NODE for one in subscribers)
        return named, unnamed


def full_name(namespace: str, name: str) -> str:
    """Return the name of a node with its namespace; a name that starts with a slash has it."""
    return name if name.startswith("/") else f"{namespace.rstrip('/')}/{name}"
