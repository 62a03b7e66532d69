"""Publishers with the recorded types and QoS."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping

from rclpy.duration import Duration
from rclpy.exceptions import NameValidationException
from rclpy.lifecycle import LifecyclePublisher

from planetary_twin_py.recording.ros2.metadata import Topic
from planetary_twin_py.recording.ros2.playback import TimedMessage

from ..base.lifecycle_node import ManagedNode, NodeError
from ..base.qos import publisher_qos
from ..base.topics import UNKNOWN_NODE, message_class

_POLL = 2e-3  # [s]
_TIMEOUT = 20.0  # [s] for a subscriber that acknowledges nothing; it may have been killed
_NOW = Duration()


class Outlet:
    """
    A publisher that reports whether the next message would overwrite an unacknowledged one.

    `depth` is the number of messages that `publisher` keeps.
    """

    def __init__(self, publisher: LifecyclePublisher, depth: int) -> None:
        self.publisher = publisher
        self._depth = depth
        self._sent = 0  # since all messages were acknowledged
        self._full = 0.0  # time since which there has been no room [s]; 0 if there is

    def publish(self, data: bytes) -> None:
        """Publish a serialised message."""
        self.publisher.publish(data)
        self._sent += 1

    def has_room(self) -> bool:
        """
        Return whether the next message overwrites no unacknowledged message.

        After 20 s without room, unacknowledged messages are overwritten. A publisher
        without reliable subscribers always has room.
        """
        if self._sent < self._depth:
            return True
        now = time.monotonic()
        self._full = self._full or now
        if not self.acknowledged():
            return now > self._full + _TIMEOUT
        self._sent = 0
        self._full = 0.0
        return True

    def acknowledged(self) -> bool:
        """Return whether every reliable subscriber has acknowledged every message."""
        # Poll only: rclpy holds the interpreter lock while it waits, so no service would answer.
        return bool(self.publisher.wait_for_all_acked(_NOW))


class Outlets:
    """
    A publisher of `node` for each of `topics`, with its recorded type and QoS.

    `names` maps recorded names to the names to publish. Raises `NodeError` if a publisher cannot
    be created.
    """

    def __init__(
        self, node: ManagedNode, topics: Iterable[Topic], names: Mapping[str, str]
    ) -> None:
        self._node = node
        self._names = names
        self._outlets: dict[str, Outlet] = {}
        for topic in topics:
            self._create(topic)

    def __len__(self) -> int:
        return len(self._outlets)

    def publish(self, message: TimedMessage) -> None:
        """Publish a message as it was recorded."""
        self._outlets[message.topic].publish(message.data)

    def has_room(self, message: TimedMessage) -> bool:
        """Return whether `message` overwrites no unacknowledged message."""
        return self._outlets[message.topic].has_room()

    def shared(self) -> list[str]:
        """Return the names of the topics that have other publishers, too."""
        names = (self._names[topic] for topic in self._outlets)
        return [name for name in names if self._node.count_publishers(name) > 1]

    def wait(self, seconds: float) -> None:
        """Wait until all messages are acknowledged, for `seconds` [s] at most."""
        deadline = time.monotonic() + seconds
        for outlet in self._outlets.values():
            while not outlet.acknowledged() and time.monotonic() < deadline:
                time.sleep(_POLL)

    def _create(self, topic: Topic) -> None:
        name = self._names[topic.name]
        try:
            kind = message_class(topic.type)
            qos = publisher_qos(topic)
        except ImportError:
            raise NodeError(f"{topic.name}: message type {topic.type} is not installed") from None
        except (KeyError, ValueError, TypeError) as defect:
            raise NodeError(f"{topic.name}: recorded QoS is unreadable: {defect!r}") from None
        try:
            publisher = self._node.outlet(kind, name, qos)
        except NameValidationException as refusal:
            raise NodeError(f"{name}: {str(refusal).splitlines()[0]}") from None
        self._outlets[topic.name] = Outlet(publisher, max(qos.depth, 1))
        if topic.type_hash and topic.type_hash not in self._type_hashes(name):
            raise NodeError(f"{topic.name}: recorded with another version of {topic.type}")

    def _type_hashes(self, name: str) -> set[str]:
        """
        Return the type hashes of this node's publishers of a topic, from the ROS graph.

        A publisher whose node is still unknown may belong to this node.
        """
        own = (self._node.get_name(), self._node.get_namespace())
        return {
            str(info.topic_type_hash)
            for info in self._node.get_publishers_info_by_topic(name)
            if (info.node_name, info.node_namespace) == own or info.node_name == UNKNOWN_NODE
        }
