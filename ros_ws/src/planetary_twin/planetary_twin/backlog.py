"""Keeps a twin from outrunning the node that records it."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping

from planetary_twin_msgs.msg import RecorderStatus
from rclpy.callback_groups import CallbackGroup
from rclpy.duration import Duration
from rclpy.lifecycle import LifecyclePublisher
from rclpy.node import Node

from .audience import PATIENCE

_NOW = Duration()
_UNSEEN = 5  # messages of a topic; ROS's default subscription, rosbag2's too, has room for 10


class _Taken(CallbackGroup):  # type: ignore[misc]
    """Of a subscription that no executor touches: its messages are taken by who needs them."""

    def can_execute(self, entity: object) -> bool:
        """Never: the executor may be waiting for the answer of a twin that is held."""
        return False


class Backlog:
    """
    What the node `name` beside `node` has still to record; a `name` that is empty is no one.

    A recorder that publishes `RecorderStatus` on `NAME/status` may be `room` messages of a topic
    behind. Another one says nothing of what it has recorded: of a topic, 5 messages at most are
    on their way until all reliable subscribers have acknowledged them, which is waited for 10 s.

    `published` counts, for each publisher that sends one message an interval, what it has sent.
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
        self._heard: dict[str, int] = {}  # what the recorder has accounted for, by topic
        self._others: dict[str, int] = {}  # of these, what other publishers must have sent
        self._recorded: dict[str, int] = {}  # the rest
        self._acknowledged: dict[LifecyclePublisher, int] = {}
        self._since = time.monotonic()  # of the last acknowledgement
        self._given_up = False
        self._status = (
            node.create_subscription(
                RecorderStatus, f"{name}/status", self._hear, 1, callback_group=_Taken()
            )
            if name
            else None
        )

    def close(self) -> None:
        """Let the subscription go."""
        if self._status is not None:
            self._node.destroy_subscription(self._status)
            self._status = None

    def has_room(self) -> bool:
        """Whether the messages of another interval may be published; from one thread."""
        if self._status is None:
            return True
        with self._status.handle:
            while taken := self._status.handle.take_message(RecorderStatus, False):
                self._hear(taken[0])
        if self._recorded and self._status.get_publisher_count():
            return self._is_close()
        return self._is_acknowledged()

    def _hear(self, status: RecorderStatus) -> None:
        """
        Take what the recorder has accounted for.

        Its counts are of topics: what they exceed the twin's own by, others have published, such
        as the twin that ran before this one.
        """
        accounts = zip(status.topics, status.recorded, status.lost, strict=True)
        heard = {topic: recorded + lost for topic, recorded, lost in accounts}
        recorded = {}
        for publisher, published in self._published().items():
            topic = publisher.topic_name
            if topic not in heard:
                continue
            began_again = heard[topic] < self._heard.get(topic, 0)
            others = 0 if began_again else self._others.get(topic, 0)
            self._others[topic] = max(others, heard[topic] - published)
            recorded[topic] = heard[topic] - self._others[topic]
        self._heard, self._recorded = heard, recorded

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
        elif not self._given_up and now > self._since + PATIENCE:
            self._given_up = True
            self._node.get_logger().warning(
                f"wait_for = {self._name}: subscribers have not acknowledged messages for "
                f"{PATIENCE:g} s; goes on, and they may lose messages"
            )
        return self._given_up or self._since == now

    def _arrived(self, publisher: LifecyclePublisher, published: int) -> bool:
        """Whether few enough messages are on their way."""
        if published - self._acknowledged.get(publisher, 0) < _UNSEEN:
            return True
        # Only polled: while rclpy waits it holds the interpreter.
        if publisher.wait_for_all_acked(_NOW):
            self._acknowledged[publisher] = published
            return True
        return False
