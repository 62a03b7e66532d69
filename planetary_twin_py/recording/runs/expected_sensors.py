"""Messages of the sensors of a run that is simulated again."""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

from ...run.window import Window
from ...scene import Scene
from ..ros2.sensor_message import SensorMessage
from ..ros2.sensor_messages import SensorMessages
from .intervals import Interval

KEPT = 64  # messages of a topic before the one that was requested last


class Expected(NamedTuple):
    """A simulated message, and the interval in which it was published."""

    interval: Interval
    window: Window
    message: SensorMessage


class ExpectedSensors:
    """Messages of the sensors of a run, by topic and number.

    Their numbers count on from run to run. So the first one that is recorded of a run is found by
    its time, and the others by their numbers.
    """

    def __init__(self, scene: Scene) -> None:
        self._messages = SensorMessages(scene)
        self._waiting: dict[str, deque[Expected]] = {}
        self._passed: dict[str, int] = {}  # messages that are not kept
        self._numbers: dict[str, int] = {}  # of the first message of a topic

    def add(self, interval: Interval, window: Window) -> None:
        """Add the messages of the next interval."""
        for message in self._messages.of(window):
            waiting = self._waiting.setdefault(message.topic, deque())
            waiting.append(Expected(interval, window, message))

    def reaches(self, topic: str, number: int | None, time: float) -> bool:
        """Whether no later interval can have a message.

        Args:
            topic: its topic, without namespace.
            number: its number; None if messages of its type have none.
            time: its simulated time [s]; about, as it follows from stamps.
        """
        waiting = self._waiting.get(topic)
        if not waiting:
            return False
        if number is None or topic not in self._numbers:
            return waiting[-1].message.time >= time
        return self._place(topic, number) < len(waiting)

    def get(self, topic: str, number: int | None, time: float) -> Expected | None:
        """The message; None if there is none. For the arguments see `reaches`."""
        waiting = self._waiting.get(topic)
        if not waiting:
            return None
        if number is None or topic not in self._numbers:
            apart = [abs(each.message.time - time) for each in waiting]
            place = apart.index(min(apart))
            if number is not None:
                self._numbers[topic] = number - place - self._passed.get(topic, 0)
        else:
            place = self._place(topic, number)
        if not 0 <= place < len(waiting):
            return None
        found = waiting[place]
        for _ in range(place - KEPT):
            waiting.popleft()
            self._passed[topic] = self._passed.get(topic, 0) + 1
        return found

    def _place(self, topic: str, number: int) -> int:
        """Place of a message among those that are kept."""
        return number - self._numbers[topic] - self._passed.get(topic, 0)
