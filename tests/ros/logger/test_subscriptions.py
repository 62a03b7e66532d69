"""The end of a recording: what waits is written, so that no state lacks its commands."""

from __future__ import annotations

import errno
from collections import deque
from types import SimpleNamespace
from typing import Any

import pytest
from planetary_twin.logger.subscriptions import RecordedTopic, RecordedTopics

from planetary_twin_py.recording.ros2.metadata import Topic

COMMANDS, STATES, WAVES = "/twin/applied_commands", "/twin/gearbox_state", "/twin/mesh_waveform"


class Queue:
    """A subscription on which messages wait."""

    msg_type = None

    def __init__(self) -> None:
        self.waiting: deque[tuple[bytes, dict[str, int]]] = deque()
        self.handle = self
        self.sent = 0

    def __enter__(self) -> Queue:
        return self

    def __exit__(self, *raised: object) -> None:
        pass

    def take_message(self, kind: object, raw: bool) -> tuple[bytes, dict[str, int]] | None:
        return self.waiting.popleft() if self.waiting else None

    def get_publisher_count(self) -> int:
        return 1

    def add(self) -> None:
        self.sent += 1
        times = dict.fromkeys(("received_timestamp", "source_timestamp"), self.sent)
        info = {"publication_sequence_number": self.sent, **times}
        self.waiting.append((b"%d" % self.sent, info))


class Disk:
    """A sink that lists what is written; each message lets the twin publish one more interval."""

    def __init__(self, queues: dict[str, Queue], publishing: int = 0) -> None:
        self.queues, self.left = queues, publishing
        self.written: dict[str, list[int]] = {name: [] for name in queues}
        self._names: list[str] = []
        self.full = False

    def add_topic(self, topic: Topic, account: object) -> int:
        self._names.append(topic.name)
        return len(self._names) - 1

    def write(self, channel: int, data: bytes, *given: int) -> None:
        if self.full:
            raise OSError(errno.ENOSPC, "No space left on device")
        self.written[self._names[channel]].append(int(data))
        if self.left:
            self.left -= 1
            publish(self.queues)


def publish(queues: dict[str, Queue]) -> None:
    """Publish the messages of one interval, in the order of the names."""
    for name in sorted(queues):
        queues[name].add()


def recorded_topics(publishing: int = 0) -> tuple[RecordedTopics, Disk, list[OSError]]:
    """Three recorded topics, of which ten intervals are queued."""
    queues = {name: Queue() for name in (STATES, COMMANDS, WAVES)}
    disk, failures = Disk(queues, publishing), list[OSError]()
    given: Any = SimpleNamespace(destroy_subscription=lambda subscription: None), (), (), disk
    topics = RecordedTopics(*given, failures.append, lambda: None)
    for name, queue in queues.items():
        topic = Topic(name, "std_msgs/msg/Empty", "", "", [])
        recorded = topics._topics[name] = RecordedTopic(
            disk, topic, False, (), failures.append, lambda: None
        )
        recorded.use(queue)  # type: ignore[arg-type]
    for _ in range(10):
        publish(queues)
    return topics, disk, failures


@pytest.mark.parametrize("publishing", [0, 1, 7, 40])
def test_no_state_is_written_without_its_commands(publishing):
    topics, disk, _ = recorded_topics(publishing)
    topics.drain()
    topics.close()
    states, commands = disk.written[STATES], disk.written[COMMANDS]
    assert states == list(range(1, len(states) + 1)) and len(states) >= 10
    assert set(states) <= set(commands)
    topics.drain()  # closed topics receive nothing
    assert disk.written[STATES] == states
