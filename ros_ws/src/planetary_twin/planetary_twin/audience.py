"""Waits for a node that is to hear a twin from its first message on."""

from __future__ import annotations

import time

from rclpy.node import Node

from .topics import UNKNOWN_NODE

PATIENCE = 10.0  # [s]
_SETTLED = 0.5  # [s] without a further subscription, after which there is none to come
_UNNAMED = 3.0  # [s] the same where the nodes of subscriptions are not known
_POLL = 0.05  # [s]


class Audience:
    """
    Whether the node `name` beside `node` has subscribed to what it wants of `node`'s topics.

    Nodes that start together find one another after some tenths of a second, or, where a message
    of the middleware's discovery gets lost, after three. To which node a subscription belongs is
    another message, which may never come: after three seconds a subscription of an unknown node
    counts as one of that node. A `name` that is empty is no one.
    """

    def __init__(self, node: Node, name: str) -> None:
        self._node = node
        self._name = name
        self._there = not name
        self._since = 0.0
        self._looked = 0.0
        self._changed = 0.0
        self._subscribed = (0, 0)

    def begin(self) -> None:
        """Count patience from now on."""
        self._since = time.monotonic()
        if not self._there:
            self._node.get_logger().info(
                f"wait_for = {self._name}: waits until it has subscribed, {PATIENCE:g} s at most"
            )

    def there(self) -> bool:
        """Whether it is there, has been before, or is waited for no longer."""
        now = time.monotonic()
        if self._there or now < self._looked + _POLL:
            return self._there
        self._looked = now
        before, self._subscribed = self._subscribed, self._subscriptions()
        if self._subscribed != before:
            self._changed = now
        named, unnamed = self._subscribed
        settled = now - self._changed
        self._there = (named > 0 and settled > _SETTLED) or (unnamed > 0 and settled > _UNNAMED)
        if not self._there and now > self._since + PATIENCE:
            self._there = True
            self._node.get_logger().warning(
                f"wait_for = {self._name}: has not subscribed within {PATIENCE:g} s; "
                "begins without it"
            )
        return self._there

    def _subscriptions(self) -> tuple[int, int]:
        """Count the matched topics of `node` that it, and that an unknown node, subscribes to."""
        wanted = self._name, self._node.get_namespace()
        named = unnamed = 0
        for publisher in self._node.publishers:
            if not publisher.get_subscription_count():
                continue
            listeners = self._node.get_subscriptions_info_by_topic(publisher.topic_name)
            named += any((one.node_name, one.node_namespace) == wanted for one in listeners)
            unnamed += any(one.node_name == UNKNOWN_NODE for one in listeners)
        return named, unnamed
