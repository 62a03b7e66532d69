"""Publishes the readings of the sensors of a scene."""

from __future__ import annotations

from array import array
from collections.abc import Mapping
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from rclpy.lifecycle import LifecyclePublisher

from planetary_twin_py import Window
from planetary_twin_py.recording.ros2.sensor_messages import SensorMessages, kinds_of
from planetary_twin_py.recording.ros2.sensor_topics import (
    OF_TEMPERATURES,
    THERMAL_STATE,
    levels_topic,
    sensor_topic,
    sensor_topics,
)
from planetary_twin_py.robot import frame_of

from ...base.lifecycle_node import ManagedNode
from ...base.topics import message_class
from ..parameters import SimulationParameters


class SensorReading(NamedTuple):
    """A message to send."""

    message: Any
    stamps: list[Any]
    """Its stamps."""


class SensorOutlets:
    """
    The publishers of the sensors of the scene on `node`, each with `kept` messages.

    `given` are the parameters. `published` are the numbers of messages sent before, by topic.
    """

    def __init__(
        self,
        node: ManagedNode,
        given: SimulationParameters,
        kept: int,
        published: Mapping[str, int],
    ) -> None:
        scene, settings = given.scene, given.settings
        self._frames = {
            topic: settings.frame_prefix + frame_of(sensor, settings.frame_id)
            for sensor in scene.sensors
            for topic in (sensor_topic(sensor.name), levels_topic(sensor.name))
        } | dict.fromkeys(OF_TEMPERATURES, settings.frame_prefix + settings.frame_id)
        self._messages = SensorMessages(scene)
        self.thermal: Mapping[str, Any] | None = None
        """Fields of the last message ThermalState; None before the first one."""
        topics = sensor_topics(kinds_of(scene))
        self._kinds = {name: message_class(kind) for name, kind in topics.items()}
        self._outlets = {
            name: node.outlet(self._kinds[name], name, kept) for name in sorted(self._kinds)
        }
        self._sent = {
            name: published.get(outlet.topic_name, 0) for name, outlet in self._outlets.items()
        }

    @property
    def publishers(self) -> list[LifecyclePublisher]:
        """All of them."""
        return [*self._outlets.values()]

    def prepared(self, window: Window) -> list[tuple[LifecyclePublisher, SensorReading, float]]:
        """Return publisher, message and instant [s] of each message of `window`, by topic."""
        if window.start == 0.0:  # another run
            self._messages.begin()
        messages = sorted(self._messages.of(window), key=itemgetter(0))
        self.thermal = next((m.fields for m in messages if m.topic == THERMAL_STATE), self.thermal)
        return [
            (self._outlets[topic], self._reading(topic, fields), instant)
            for topic, instant, fields in messages
        ]

    def _reading(self, topic: str, fields: Mapping[str, Any]) -> SensorReading:
        message = self._kinds[topic]()
        message.header.frame_id = self._frames[topic]
        if hasattr(message, "sequence"):
            self._sent[topic] += 1
            message.sequence = self._sent[topic]
        for name, value in fields.items():
            setattr(message, name, _array(value) if isinstance(value, np.ndarray) else value)
        return SensorReading(message, [message.header.stamp])


def _array(values: NDArray[Any]) -> array[Any]:
    """Return the array of a message; NumPy names 64-bit integers otherwise."""
    code = "q" if values.dtype == np.int64 else values.dtype.char
    return array(code, values.tobytes())
