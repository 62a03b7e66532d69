"""Listens to all that is to be recorded, serialised as it comes, and accounts for each message."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Sequence
from typing import Any, Protocol

from rclpy.event_handler import QoSMessageLostInfo, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.subscription import Subscription

from planetary_twin_py.recording.ros2.account import TopicAccount
from planetary_twin_py.recording.ros2.metadata import Topic

from .topics import describe, matching_qos, message_class, wanted_topics

URDF_ATTACHMENT = "robot_description.urdf"
_DESCRIPTION = "/robot_description"
_STRING = "std_msgs/msg/String"
_NOTHING: tuple[bytes, ...] = ()
_REPORTED = 400  # messages after which the recording's progress is told
_DEAF = 3.0  # [s] for which a subscription may find none of the publishers that there are
_BATCH = 200  # messages of one topic before it is another's turn
_CDR_HEADER = 8  # bytes: encapsulation, then the length of the text with its closing zero


class Sink(Protocol):
    """Where messages go; each method raises `OSError` where they cannot."""

    def attach(self, name: str, data: bytes, media_type: str) -> None:
        """Add a file beside the messages."""

    def add_topic(self, topic: Topic, account: TopicAccount) -> int:
        """Open a channel."""

    def write(
        self, channel: int, data: bytes, log_time: int, publish_time: int, sequence: int
    ) -> None:
        """Take one message."""


Failed = Callable[[OSError], None]


class Tap:
    """One recorded topic: its subscription, its channel in the sink, its account."""

    def __init__(
        self,
        sink: Sink,
        topic: Topic,
        latched: bool,
        own: Collection[bytes],
        failed: Failed,
        accounted: Callable[[], None],
    ) -> None:
        self.account = TopicAccount(latched)
        self.subscription: Subscription | None = None
        self._matched = 0.0  # [s] when it last had a publisher, or was made
        self._sink = sink
        self._own = own
        self._failed = failed
        self._accounted = accounted
        self._channel = sink.add_topic(topic, self.account)
        self._describes = topic.type == _STRING and topic.name.endswith(_DESCRIPTION)

    def publishers(self) -> int:
        """Count the publishers matched now, this node's own left out."""
        own = self._own is not _NOTHING
        return self.subscription.get_publisher_count() - own if self.subscription else 0

    def listen(self, subscription: Subscription | None) -> None:
        """Take messages from `subscription`, or from none."""
        self.subscription, self._matched = subscription, time.monotonic()

    def deaf(self) -> bool:
        """
        Whether the subscription has found no publisher for 3 s.

        Its QoS may be too strong for one that came later, or the match got lost.
        """
        if self.publishers():
            self._matched = time.monotonic()
        return time.monotonic() > self._matched + _DEAF

    def receive(self, raw: bytes, info: dict[str, Any]) -> None:
        """
        Write a message, and those that wait behind it.

        The executor would bring them one by one, at ten times the cost of writing one.
        """
        subscription = self.subscription
        if subscription is None:  # what was on its way when the tap was closed
            return
        self._write(raw, info)
        with subscription.handle:
            for _ in range(_BATCH):
                waiting = subscription.handle.take_message(subscription.msg_type, True)
                if waiting is None or self.subscription is None:
                    return
                self._write(*waiting)

    def _write(self, raw: bytes, info: dict[str, Any]) -> None:
        if raw in self._own:
            return
        number = info["publication_sequence_number"]
        received = info["received_timestamp"] or time.time_ns()
        sent = info["source_timestamp"] or received
        try:
            self._sink.write(self._channel, raw, received, sent, number)
            if self._describes:
                self._sink.attach(URDF_ATTACHMENT, raw[_CDR_HEADER:].rstrip(b"\0"), "text/xml")
        except OSError as reason:
            self._failed(reason)
            return
        self.account.receive(number, self.publishers)
        self._accounted()

    def told_of_loss(self, event: QoSMessageLostInfo) -> None:
        """Hear from the middleware of messages it could not deliver."""
        self.account.reported += event.total_count_change


class Taps:
    """
    The taps of one recording; `failed` hears why the sink takes no more.

    `progressed` is called after every 400 messages, of whatever topics.

    What the node itself has published, of late in `own`, is not recorded: so a recording of a
    replay holds what was replayed.
    """

    def __init__(
        self,
        node: Node,
        chosen: Sequence[str],
        own: Collection[bytes],
        sink: Sink,
        failed: Failed,
        progressed: Callable[[], None],
    ) -> None:
        self._node = node
        self._chosen = chosen
        self._own = own
        self._sink = sink
        self._failed = failed
        self._progressed = progressed
        self._unreported = 0
        self._taps: dict[str, Tap] = {}
        self._refused: set[str] = set()

    @property
    def accounts(self) -> dict[str, TopicAccount]:
        """By topic; of all that were ever heard of."""
        return {name: tap.account for name, tap in self._taps.items()}

    @property
    def heard(self) -> dict[str, TopicAccount]:
        """Accounts of topics that have a publisher now, or have had one."""
        return {
            name: tap.account
            for name, tap in self._taps.items()
            if tap.account.recorded or tap.publishers()
        }

    def discover(self) -> None:
        """Subscribe to what there is."""
        for name in wanted_topics(self._node, self._chosen):
            self._subscribe(name)

    def close(self) -> None:
        """Listen no more; `discover` listens again."""
        for tap in self._taps.values():
            self._leave(tap)

    def _count(self) -> None:
        self._unreported += 1
        if self._unreported >= _REPORTED:
            self._unreported = 0
            self._progressed()

    def _leave(self, tap: Tap) -> None:
        if tap.subscription is not None:
            self._node.destroy_subscription(tap.subscription)
            tap.listen(None)

    def _subscribe(self, name: str) -> None:
        tap = self._taps.get(name)
        everybody = self._node.get_publishers_info_by_topic(name)
        here = self._node.get_name(), self._node.get_namespace()
        publishers = [p for p in everybody if (p.node_name, p.node_namespace) != here]
        if name in self._refused or not publishers:
            return
        if tap and tap.subscription:
            if not tap.deaf():
                return
            self._leave(tap)
        try:
            topic = describe(name, publishers)
            kind = message_class(topic.type)
        except (ImportError, FileNotFoundError) as missing:
            self._refused.add(name)
            self._node.get_logger().warning(f"{name} is not recorded: {missing}")
            return
        qos = matching_qos(publishers)
        if tap is None:
            latched = qos.durability == DurabilityPolicy.TRANSIENT_LOCAL
            own = self._own if len(publishers) < len(everybody) else _NOTHING
            tap = self._taps[name] = Tap(
                self._sink, topic, latched, own, self._failed, self._count
            )
        tap.listen(self._subscription(kind, name, tap, qos))

    def _subscription(self, kind: type, name: str, tap: Tap, qos: QoSProfile) -> Subscription:
        events = SubscriptionEventCallbacks(message_lost=tap.told_of_loss)
        return self._node.create_subscription(
            kind, name, tap.receive, qos, raw=True, event_callbacks=events
        )
