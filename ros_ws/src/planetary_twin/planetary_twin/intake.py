"""Receives the messages of a measured gearbox in the order of their arrival."""

from __future__ import annotations

import time
from typing import Any

from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node
from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.subscription import Subscription

from planetary_twin_py.following.measured_messages import (
    ENCODERS,
    JOINTS,
    TEMPERATURE,
    VIBRATION,
    Arrived,
)

from .topics import matching_qos, message_class

MEASURED = {
    "measured/joint_states": JOINTS[0],
    "measured/dynamic_joint_states": JOINTS[1],
    "measured/oil_temperature": TEMPERATURE,
    "measured/encoders": ENCODERS,
    "measured/vibration": VIBRATION,
}
"""Types of the topics of a measured gearbox, by name."""
_ANY = QoSProfile(history=HistoryPolicy.KEEP_ALL, reliability=ReliabilityPolicy.BEST_EFFORT)


class _Polled(CallbackGroup):  # type: ignore[misc]
    """Excludes subscriptions from the executor: `Intake.take` polls them."""

    def can_execute(self, entity: object) -> bool:
        """Return False: the executor would take longer than the processing of a message."""
        return False


class _Inlet:
    """One topic: its subscription, whose reliability is that of all of its publishers."""

    def __init__(self, node: Node, topic: str, kind: str, group: CallbackGroup) -> None:
        self.name, self.kind = node.resolve_topic_name(topic), kind
        self._node, self._class, self._group = node, message_class(kind), group
        self._subscription = self._subscribed(_ANY)
        self.publishers = 0
        self._matched = 0  # publishers whose offers are known

    def follow_publishers(self) -> list[tuple[int, Any]]:
        """Renew the subscription if the offered reliability changed; return queued messages."""
        self.publishers = matched = self._node.count_publishers(self.name)
        if matched == self._matched:
            return []
        publishers = self._node.get_publishers_info_by_topic(self.name)
        self._matched = matched if len(publishers) == matched else 0
        if not publishers:
            return []
        offered = matching_qos(publishers).reliability
        if offered == self._subscription.qos_profile.reliability:
            return []
        before = self._subscription
        self._subscription = self._subscribed(
            QoSProfile(history=HistoryPolicy.KEEP_ALL, reliability=offered)
        )
        waited = self._taken(before)
        self._node.destroy_subscription(before)
        return waited

    def take(self) -> list[tuple[int, Any]]:
        """Return time of arrival [ns] and contents of the queued messages."""
        return self._taken(self._subscription)

    def close(self) -> None:
        """Destroy the subscription."""
        self._node.destroy_subscription(self._subscription)

    def _subscribed(self, qos: QoSProfile) -> Subscription:
        return self._node.create_subscription(
            self._class, self.name, _unused, qos, callback_group=self._group
        )

    def _taken(self, subscription: Subscription) -> list[tuple[int, Any]]:
        found = []
        with subscription.handle:
            while taken := subscription.handle.take_message(self._class, False):
                message, info = taken
                found.append((info["received_timestamp"] or time.time_ns(), message))
        return found


class Intake:
    """
    Subscribes `node` to the topics in `MEASURED` whose types are installed.

    A subscription is best effort until publishers are known, and reliable if all of them are:
    then no message is lost. Only one thread may call `take`.
    """

    def __init__(self, node: Node) -> None:
        group = _Polled()
        self._inlets = []
        self.missing: list[str] = []
        """Types that are not installed."""
        for topic, kind in MEASURED.items():
            try:
                self._inlets.append(_Inlet(node, topic, kind, group))
            except ImportError:
                self.missing.append(kind)
        self._waited: list[tuple[int, _Inlet, Any]] = []

    def follow_publishers(self) -> None:
        """Renew the subscriptions to topics whose publishers offer another reliability."""
        for inlet in self._inlets:
            self._waited += [(at, inlet, message) for at, message in inlet.follow_publishers()]

    @property
    def shared(self) -> list[str]:
        """
        Names of the topics of one sensor that have several publishers.

        Messages do not identify their publisher. Joints have names, so several may publish them.
        """
        return [
            inlet.name
            for inlet in self._inlets
            if inlet.publishers > 1 and inlet.kind not in JOINTS
        ]

    def take(self) -> list[Arrived]:
        """Return the messages that have arrived since the last call, in order."""
        found, self._waited = self._waited, []
        for inlet in self._inlets:
            found += [(at, inlet, message) for at, message in inlet.take()]
        found.sort(key=lambda one: one[0])  # stable: a topic keeps its order
        return [
            Arrived(inlet.name, inlet.kind, 1e-9 * at, message) for at, inlet, message in found
        ]

    def close(self) -> None:
        """Destroy the subscriptions."""
        for inlet in self._inlets:
            inlet.close()


def _unused(message: object) -> None:
    """Do nothing: `create_subscription` requires a callback, which is never called."""
