"""Receives the serialised messages to record, and counts recorded and lost ones by topic."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Iterator, Sequence
from typing import Any

from rclpy.event_handler import QoSMessageLostInfo, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.subscription import Subscription

from planetary_twin_py.recording.ros2.account import TopicAccount
from planetary_twin_py.recording.ros2.bag import BagWriter
from planetary_twin_py.recording.ros2.metadata import Topic
from planetary_twin_py.recording.ros2.ring import Ring

from ..base.topics import describe, matching_qos, message_class, wanted_topics

URDF_ATTACHMENT = "robot_description.urdf"
_DESCRIPTION = "/robot_description"
_STRING = "std_msgs/msg/String"
_NOTHING: tuple[bytes, ...] = ()
_REPORTED = 400  # messages between two calls of `progressed`
_UNMATCHED = 3.0  # [s] after which a subscription without a publisher is created again
_BATCH = 200  # messages of one topic that are written before those of other topics
_QUEUE = 5000  # largest number of queued messages of one topic
_CDR_HEADER = 8  # bytes: encapsulation, then the length of the text with its closing zero


Sink = BagWriter | Ring
Failed = Callable[[OSError], None]


class RecordedTopic:
    """One recorded topic: its subscription, its channel in `sink` and its message counts."""

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
        self._matched = 0.0  # [s] time at which it last had a publisher, or was created
        self._sink = sink
        self._own = own
        self._failed = failed
        self._accounted = accounted
        self._channel = sink.add_topic(topic, self.account)
        self._describes = topic.type == _STRING and topic.name.endswith(_DESCRIPTION)

    def publishers(self) -> int:
        """Return the number of matched publishers, without this node's own."""
        own = self._own is not _NOTHING
        return self.subscription.get_publisher_count() - own if self.subscription else 0

    def use(self, subscription: Subscription | None) -> None:
        """Receive messages from `subscription`; None: from no subscription."""
        self.subscription, self._matched = subscription, time.monotonic()

    def unmatched(self) -> bool:
        """
        Return whether the subscription has had no publisher for 3 s.

        Its QoS may be incompatible with a publisher that came later, or a discovery message was
        lost.
        """
        if self.publishers():
            self._matched = time.monotonic()
        return time.monotonic() > self._matched + _UNMATCHED

    def receive(self, raw: bytes, info: dict[str, Any]) -> None:
        """
        Write a message, and those queued behind it.

        The executor would deliver them one by one, at ten times the cost of writing one.
        """
        if self.subscription is None:  # a message in transit when recording ended
            return
        try:
            self._write(raw, info)
            self._accounted()
            for waiting in self._waiting(_BATCH):
                self._write(*waiting)
                self._accounted()
        except OSError as reason:
            self._failed(reason)

    def drain(self) -> None:
        """Write the queued messages; raises `OSError` if the sink cannot write."""
        for waiting in self._waiting(_QUEUE):
            self._write(*waiting)

    def _waiting(self, most: int) -> Iterator[tuple[bytes, dict[str, Any]]]:
        """Take at most `most` queued messages."""
        subscription = self.subscription
        if subscription is None:
            return
        with subscription.handle:
            for _ in range(most):
                waiting = subscription.handle.take_message(subscription.msg_type, True)
                if waiting is None or self.subscription is None:
                    return
                yield waiting

    def _write(self, raw: bytes, info: dict[str, Any]) -> None:
        if raw in self._own:
            return
        number = info["publication_sequence_number"]
        received = info["received_timestamp"] or time.time_ns()
        sent = info["source_timestamp"] or received
        self._sink.write(self._channel, raw, received, sent, number)
        if self._describes:
            self._sink.attach(URDF_ATTACHMENT, raw[_CDR_HEADER:].rstrip(b"\0"), "text/xml")
        self.account.receive(number, self.publishers)

    def on_message_lost(self, event: QoSMessageLostInfo) -> None:
        """Count messages that the middleware could not deliver."""
        self.account.reported += event.total_count_change


class RecordedTopics:
    """
    The topics of one recording into `sink`, on subscriptions of `node`.

    `chosen` are the topics to record; empty: those of the namespace. `own` are the newest messages
    of the node itself, which are not recorded, so that a recording of a replay contains the
    replayed messages only. `failed` is called with the exception if the sink cannot write,
    `progressed` after every 400 messages of all topics.
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
        self._topics: dict[str, RecordedTopic] = {}
        self._refused: set[str] = set()

    @property
    def accounts(self) -> dict[str, TopicAccount]:
        """Message counts by topic, of all topics found so far."""
        return {name: recorded.account for name, recorded in self._topics.items()}

    @property
    def matched(self) -> dict[str, TopicAccount]:
        """Message counts of the topics that have, or have had, a publisher."""
        return {
            name: recorded.account
            for name, recorded in self._topics.items()
            if recorded.account.recorded or recorded.publishers()
        }

    def discover(self) -> None:
        """Subscribe to new topics."""
        for name in wanted_topics(self._node, self._chosen):
            self._subscribe(name)

    def drain(self) -> None:
        """
        Write the queued messages at the end; raises `OSError` if the sink cannot write.

        A twin publishes each interval in the order of the topics' names: first its commands, then
        its state. In the reverse order, no state is written without its commands.
        """
        for name in sorted(self._topics, reverse=True):
            self._topics[name].drain()

    def close(self) -> None:
        """Destroy the subscriptions; `discover` subscribes again."""
        for recorded in self._topics.values():
            self._unsubscribe(recorded)

    def _count(self) -> None:
        self._unreported += 1
        if self._unreported >= _REPORTED:
            self._unreported = 0
            self._progressed()

    def _unsubscribe(self, recorded: RecordedTopic) -> None:
        if recorded.subscription is not None:
            self._node.destroy_subscription(recorded.subscription)
            recorded.use(None)

    def _subscribe(self, name: str) -> None:
        recorded = self._topics.get(name)
        all_publishers = self._node.get_publishers_info_by_topic(name)
        here = self._node.get_name(), self._node.get_namespace()
        publishers = [p for p in all_publishers if (p.node_name, p.node_namespace) != here]
        if name in self._refused or not publishers:
            return
        if recorded and recorded.subscription:
            if not recorded.unmatched():
                return
            self._unsubscribe(recorded)
        try:
            topic = describe(name, publishers)
            kind = message_class(topic.type)
        except (ImportError, FileNotFoundError) as missing:
            self._refused.add(name)
            self._node.get_logger().warning(f"{name} is not recorded: {missing}")
            return
        qos = matching_qos(publishers)
        if recorded is None:
            latched = qos.durability == DurabilityPolicy.TRANSIENT_LOCAL
            own = self._own if len(publishers) < len(all_publishers) else _NOTHING
            recorded = self._topics[name] = RecordedTopic(
                self._sink, topic, latched, own, self._failed, self._count
            )
        recorded.use(self._subscription(kind, name, recorded, qos))

    def _subscription(
        self, kind: type, name: str, recorded: RecordedTopic, qos: QoSProfile
    ) -> Subscription:
        events = SubscriptionEventCallbacks(message_lost=recorded.on_message_lost)
        receive: Any = recorded.receive  # rclpy's type lacks the second argument
        return self._node.create_subscription(
            kind, name, receive, qos, raw=True, event_callbacks=events
        )
