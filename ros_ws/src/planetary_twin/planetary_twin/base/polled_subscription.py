"""Subscriptions from which a thread takes the messages itself, without the executor."""

from __future__ import annotations

import time
from itertools import count
from typing import Any

from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.subscription import Subscription


class _NotExecuted(CallbackGroup):
    """Excludes a subscription from the executor."""

    def can_execute(self, entity: object) -> bool:
        """Return False."""
        return False


class PolledSubscription:
    """
    A subscription outside the executor, which takes longer for a message than its processing.

    Only one thread at a time may call `take`.
    """

    def __init__(self, node: Node, kind: type, topic: str, qos: QoSProfile) -> None:
        self._node, self._kind = node, kind
        self._subscription: Subscription = node.create_subscription(
            kind, topic, _unused, qos, callback_group=_NotExecuted()
        )

    @property
    def reliability(self) -> ReliabilityPolicy:
        """Return the requested reliability."""
        return self._subscription.qos_profile.reliability

    def publishers(self) -> int:
        """Return the number of matched publishers."""
        return int(self._subscription.get_publisher_count())

    def take(self, most: int | None = None) -> list[tuple[int, Any]]:
        """
        Return time of arrival by the system clock [ns] and contents of the queued messages.

        `most` limits their number: a publisher may be faster than this thread.
        """
        found = []
        with self._subscription.handle:
            for _ in count() if most is None else range(most):
                taken = self._subscription.handle.take_message(self._kind, False)
                if taken is None:
                    break
                message, info = taken
                found.append((info["received_timestamp"] or time.time_ns(), message))
        return found

    def close(self) -> None:
        """Destroy the subscription."""
        self._node.destroy_subscription(self._subscription)


def _unused(message: object) -> None:
    """Do nothing: `create_subscription` requires a callback, which is never called."""
