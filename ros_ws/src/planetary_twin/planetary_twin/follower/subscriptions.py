"""Receives the messages of a measured gearbox in the order of their arrival."""

from __future__ import annotations

from typing import Any

from rclpy.node import Node
from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy

from planetary_twin_py.following.channels.message_types import JOINTS
from planetary_twin_py.following.measured.messages import Arrived

from ..base.polled_subscription import PolledSubscription
from ..base.topics import MEASURED, matching_qos, message_class

_ANY = QoSProfile(history=HistoryPolicy.KEEP_ALL, reliability=ReliabilityPolicy.BEST_EFFORT)


class _Inlet:
    """One topic: its subscription, whose reliability is that of all of its publishers."""

    def __init__(self, node: Node, topic: str, kind: str) -> None:
        self.name, self.kind = node.resolve_topic_name(topic), kind
        self._node, self._class = node, message_class(kind)
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
        if offered == self._subscription.reliability:
            return []
        before = self._subscription
        self._subscription = self._subscribed(
            QoSProfile(history=HistoryPolicy.KEEP_ALL, reliability=offered)
        )
        waited = before.take()
        before.close()
        return waited

    def take(self) -> list[tuple[int, Any]]:
        """Return time of arrival [ns] and contents of the queued messages."""
        return self._subscription.take()

    def close(self) -> None:
        """Destroy the subscription."""
        self._subscription.close()

    def _subscribed(self, qos: QoSProfile) -> PolledSubscription:
        return PolledSubscription(self._node, self._class, self.name, qos)


class Intake:
    """
    Subscribes `node` to the topics in `MEASURED` whose types are installed.

    A subscription is best effort until publishers are known, and reliable if all of them are:
    then no message is lost. Only one thread may call `take`.
    """

    def __init__(self, node: Node) -> None:
        self._inlets = []
        self.missing: list[str] = []
        """Types that are not installed."""
        for topic, kind in MEASURED.items():
            try:
                self._inlets.append(_Inlet(node, topic, kind))
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
