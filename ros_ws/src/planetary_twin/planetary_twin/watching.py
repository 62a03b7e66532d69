"""What a running twin publishes, as the records of a recording in the making."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Iterator
from functools import partial
from typing import Any

from mcap.records import Channel, Message, Schema
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from planetary_twin_py.recording.container.records import RecordingError
from planetary_twin_py.recording.ros2.schema import message_definition
from planetary_twin_py.recording.ros2.topics import ORIGIN, POINT, STATE, WAVEFORM

from .client import Client
from .network import stay_on_this_machine
from .topics import message_class

# A twin neither waits for who looks on nor sends again: what is missed is missed.
_PASSING = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
_LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_TOPICS = {
    STATE: ("planetary_twin_msgs/msg/GearboxState", _PASSING),
    WAVEFORM: ("planetary_twin_msgs/msg/MeshWaveform", _PASSING),
    POINT: ("planetary_twin_msgs/msg/OperatingPoint", _LATCHED),
    ORIGIN: ("std_msgs/msg/String", _LATCHED),
}
_BATCH = 0.1  # [s] between two batches
_ROOM = 2000  # messages that wait for the next batch at most, some 100 MB
_SILENCE = 10.0  # [s] longest wait for a twin


def follow(namespace: str, duration: float | None) -> Iterator[list[Any]]:
    """
    Yield batches of MCAP records for `duration` [s], without it for ever.

    Raises `RecordingError` where nothing publishes.
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


class _Watch(Client):
    """Hears a twin; of a backlog that nobody takes it keeps the newest."""

    def __init__(self, namespace: str) -> None:
        super().__init__("view", namespace)
        self._heard: set[int] = set()
        self._records: deque[Any] = deque(maxlen=_ROOM)
        self._definitions: list[Any] = []
        for number, (name, (kind, qos)) in enumerate(_TOPICS.items(), start=1):
            topic = self.node.resolve_topic_name(name)
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
            hear = partial(self._hear, number)
            self.node.create_subscription(message_class(kind), name, hear, qos, raw=True)

    def complete(self) -> bool:
        """Whether all that a picture needs has been heard."""
        return {_number(STATE), _number(ORIGIN)} <= self._heard

    def take(self) -> list[Any]:
        """Return the records since the last call, definitions first."""
        definitions, self._definitions = self._definitions, []
        count = len(self._records)  # what comes meanwhile is of the next batch
        return definitions + [self._records.popleft() for _ in range(count)]

    def _hear(self, number: int, data: bytes) -> None:
        now = time.time_ns()
        self._records.append(
            Message(channel_id=number, data=data, log_time=now, publish_time=now, sequence=0)
        )
        self._heard.add(number)


def _number(name: str) -> int:
    return 1 + list(_TOPICS).index(name)
