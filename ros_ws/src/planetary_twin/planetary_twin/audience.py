"""Waits for a node that is to hear a twin from its first message on."""

from __future__ import annotations

import time

from rclpy.node import Node

PATIENCE = 10.0  # [s]
_SETTLED = 0.5  # [s] without a further subscription, after which there is none to come
_POLL = 0.05  # [s]


class Audience:
    """
    Whether the node `name` beside `node` has subscribed to what it wants of `node`'s topics.

    Nodes that start together find one another after some tenths of a second, or, where a message
    of the middleware's discovery gets lost, after three. A `name` that is empty is no one.
    """

    def __init__(self, node: Node, name: str) -> None:
        self._node = node
        self._name = name
        self._there = not name
        self._since = 0.0
        self._looked = 0.0
        self._changed = 0.0
        self._subscribed = 0

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
        self._there = self._subscribed > 0 and now > self._changed + _SETTLED
        if not self._there and now > self._since + PATIENCE:
            self._there = True
            self._node.get_logger().warning(
                f"wait_for = {self._name}: has not subscribed within {PATIENCE:g} s; "
                "begins without it"
            )
        return self._there

    def _subscriptions(self) -> int:
        """Count its subscriptions to topics of `node` that are matched."""
        wanted = self._name, self._node.get_namespace()
        return sum(
            publisher.get_subscription_count() > 0
            and any(
                (listener.node_name, listener.node_namespace) == wanted
                for listener in self._node.get_subscriptions_info_by_topic(publisher.topic_name)
            )
            for publisher in self._node.publishers
        )
