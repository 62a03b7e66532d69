"""The messages of a running twin as MCAP records."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Iterator
from functools import partial
from typing import Any

from mcap.records import Channel, Message, Schema
from rclpy.qos import QoSProfile, ReliabilityPolicy

from planetary_twin_py.recording.container.records import RecordingError
from planetary_twin_py.recording.ros2.definitions import KINDS
from planetary_twin_py.recording.ros2.schema import message_definition
from planetary_twin_py.recording.ros2.sensor_topics import SAMPLED, SENSORS
from planetary_twin_py.recording.ros2.topics import (
    AXES_STATE,
    AXES_WAVEFORM,
    ORIGIN,
    POINT,
    STATE,
    WAVEFORM,
)

from ..base.qos import LATCHED
from ..base.topics import message_class
from .client import Client
from .loopback import stay_on_this_machine

# A viewer must not delay the twin: lost messages are not sent again.
_BEST_EFFORT = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
_TOPICS = {
    STATE: _BEST_EFFORT,
    WAVEFORM: _BEST_EFFORT,
    AXES_STATE: _BEST_EFFORT,
    AXES_WAVEFORM: _BEST_EFFORT,
    POINT: LATCHED,
    ORIGIN: LATCHED,
}
_BATCH = 0.1  # [s] between two batches
_MAX_MESSAGES = 2000  # in the next batch, some 100 MB
_SILENCE = 10.0  # [s] longest wait for a twin


def follow(namespace: str, duration: float | None) -> Iterator[list[Any]]:
    """
    Yield batches of MCAP records of the twin in `namespace` for `duration` [s]; None: forever.

    Raises `RecordingError` if no twin publishes.
    """
    stay_on_this_machine()
    with _Watch(namespace) as watch:
        if not watch.wait(watch.complete, _SILENCE):
            raise RecordingError(
                f"no twin publishes in {watch.namespace}: start one with `planetary-twin run`, "
                "or name a recording"
            )
        end = math.inf if duration is None else time.monotonic() + duration
        while time.monotonic() < end:
            time.sleep(_BATCH)
            yield watch.take()
        yield watch.take()  # what has arrived while the last batch was drawn


class _Watch(Client):
    """Subscribes to a twin in `namespace`; keeps the newest messages until `take` is called."""

    def __init__(self, namespace: str) -> None:
        super().__init__("view", namespace)
        self._received: set[int] = set()  # numbers of topics
        self._records: deque[Any] = deque(maxlen=_MAX_MESSAGES)
        self._definitions: list[Any] = []
        self._topics: set[str] = set()
        for name, qos in _TOPICS.items():
            self._subscribe(name, KINDS[name], qos)

    def _subscribe(self, name: str, kind: str, qos: QoSProfile) -> None:
        topic = self.node.resolve_topic_name(name)
        self._topics.add(topic)
        number = len(self._topics)
        text = message_definition(kind).encode()
        self._definitions += [
            Schema(id=number, data=text, encoding="ros2msg", name=kind),
            Channel(
                id=number,
                topic=topic,
                message_encoding="cdr",
                metadata={},
                schema_id=number,
            ),
        ]
        callback = partial(self._on_message, number)
        self.node.create_subscription(message_class(kind), topic, callback, qos, raw=True)

    def _discover(self) -> None:
        """Subscribe to sensors that send blocks of samples."""
        below = self.node.resolve_topic_name(SENSORS) + "/"
        for topic, kinds in self.node.get_topic_names_and_types():
            if topic.startswith(below) and SAMPLED in kinds and topic not in self._topics:
                self._subscribe(topic, SAMPLED, _BEST_EFFORT)

    def complete(self) -> bool:
        """Return whether the messages that a viewer needs have been received."""
        return {_number(STATE), _number(ORIGIN)} <= self._received

    def take(self) -> list[Any]:
        """Return the records since the last call, definitions first."""
        self._discover()
        definitions, self._definitions = self._definitions, []
        count = len(self._records)  # later messages belong to the next batch
        return definitions + [self._records.popleft() for _ in range(count)]

    def _on_message(self, number: int, data: bytes) -> None:
        now = time.time_ns()
        self._records.append(
            Message(channel_id=number, data=data, log_time=now, publish_time=now, sequence=0)
        )
        self._received.add(number)


def _number(name: str) -> int:
    return 1 + list(_TOPICS).index(name)
