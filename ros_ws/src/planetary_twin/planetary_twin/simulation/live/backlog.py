"""Keeps a twin from publishing faster than the recorder writes."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping

from planetary_twin_msgs.msg import RecorderStatus
from rclpy.duration import Duration
from rclpy.lifecycle import LifecyclePublisher
from rclpy.node import Node
from rclpy.qos import QoSProfile

from ...base.polled_subscription import PolledSubscription
from ...base.subscription_wait import TIMEOUT

_NOW = Duration()
_SILENCE = 20.0  # [s] without a status, after which the recorder may have been killed
_UNSEEN = 5  # messages of a topic; the queue of a subscription holds 10 in ROS 2 and in rosbag2


class Backlog:
    """
    Messages that the node `name` has not recorded yet.

    A name that does not start with a slash is relative to the namespace of `node`.

    A recorder that publishes `RecorderStatus` on `NAME/status` may lag by `room` messages per
    topic. Other recorders, and one whose last status is 20 s old, do not report what they have
    recorded. For them, at most 5 messages per topic are in transit until all reliable subscribers
    have acknowledged them, or 10 s have passed. If `name` is empty, there is always room.

    `published` returns the number of messages that each publisher has sent, for the publishers
    that send one message per interval.

    Publishers with KEEP_ALL would not do this: Fast DDS of Jazzy blocks each `publish` for 0.1 s
    once any reliable subscriber has not acknowledged 5000 messages, and then discards the message.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        published: Callable[[], Mapping[LifecyclePublisher, int]],
        room: int,
    ) -> None:
        self._node = node
        self._name = name
        self._published = published
        self._room = room
        self._accounted: dict[str, int] = {}  # messages recorded or lost, by topic
        self._others: dict[str, int] = {}  # of these, messages of other publishers
        self._recorded: dict[str, int] = {}  # the rest
        self._acknowledged: dict[LifecyclePublisher, int] = {}
        self._since = time.monotonic()  # time of the last acknowledgement
        self._reported = self._since  # time of the last status
        self._given_up = False
        # Polled: the executor may be waiting for a twin that waits for its recorder.
        self._status = (
            PolledSubscription(node, RecorderStatus, f"{name}/status", QoSProfile(depth=1))
            if name
            else None
        )

    def close(self) -> None:
        """Destroy the subscription."""
        if self._status is not None:
            self._status.close()
            self._status = None

    def has_room(self) -> bool:
        """Return whether another interval may be published; call it from one thread only."""
        if self._status is None:
            return True
        for _, status in self._status.take():
            self._on_status(status)
            self._reported = time.monotonic()
        silent = time.monotonic() > self._reported + _SILENCE
        if self._recorded and self._status.publishers() and not silent:
            return self._is_close()
        return self._is_acknowledged()

    def _on_status(self, status: RecorderStatus) -> None:
        """
        Update the counts of the recorder.

        It counts by topic. Any excess over the twin's own count comes from other publishers, such
        as an earlier twin.
        """
        accounts = zip(status.topics, status.recorded, status.lost, strict=True)
        accounted = {topic: recorded + lost for topic, recorded, lost in accounts}
        recorded = {}
        for publisher, published in self._published().items():
            topic = publisher.topic_name
            if topic not in accounted:
                continue
            restarted = accounted[topic] < self._accounted.get(topic, 0)
            others = 0 if restarted else self._others.get(topic, 0)
            self._others[topic] = max(others, accounted[topic] - published)
            recorded[topic] = accounted[topic] - self._others[topic]
        self._accounted, self._recorded = accounted, recorded

    def _is_close(self) -> bool:
        recorded = self._recorded
        return all(
            published - recorded.get(publisher.topic_name, published) < self._room
            for publisher, published in self._published().items()
        )

    def _is_acknowledged(self) -> bool:
        now = time.monotonic()
        if all(self._arrived(*sent) for sent in self._published().items()):
            self._since, self._given_up = now, False
        elif not self._given_up and now > self._since + TIMEOUT:
            self._given_up = True
            self._node.get_logger().warning(
                f"wait_for = {self._name}: subscribers have not acknowledged messages for "
                f"{TIMEOUT:g} s; the twin continues, and they may lose messages"
            )
        return self._given_up or self._since == now

    def _arrived(self, publisher: LifecyclePublisher, published: int) -> bool:
        """Return whether few enough messages are in transit."""
        if published - self._acknowledged.get(publisher, 0) < _UNSEEN:
            return True
        # Poll only: rclpy holds the interpreter lock while it waits.
        if publisher.wait_for_all_acked(_NOW):
            self._acknowledged[publisher] = published
            return True
        return False
