"""Fields of the messages of the sensors of a twin, window by window."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from ...run.window import Window
from ...scene import Scene
from ...scene.sensors import AnySensor, Encoder
from ...sensors.levels import LevelMeter
from ...sensors.sensed import Readings
from ..ros2.sensor_topics import (
    ENCODERS,
    KINDS,
    PULSES,
    SAMPLED,
    TEMPERATURE,
    levels_topic,
    sensor_topic,
    sensor_topics,
)

ZERO_CELSIUS = 273.15  # [K]; Temperature is in degrees Celsius


class SensorMessage(NamedTuple):
    """A message of a sensor."""

    topic: str
    """Without namespace."""
    instant: float
    """Simulated time of its stamp [s]."""
    fields: Mapping[str, Any]
    """Fields without header and sequence; arrays are those of NumPy."""


class SensorStreams:
    """Makes the messages of the sensors of a scene, from the windows of one run after another.

    Args:
        scene: has the sensors.
    """

    def __init__(self, scene: Scene) -> None:
        self._sensors = {sensor.name: sensor for sensor in scene.sensors}
        self.topics = sensor_topics({sensor.name: sensor.kind for sensor in scene.sensors})
        """Types of the topics."""
        self._meters: dict[str, LevelMeter] = {}

    def messages(self, window: Window) -> Iterator[SensorMessage]:
        """The messages of a window; the windows of a run follow one another from time 0.

        Args:
            window: has the readings.
        """
        if window.start == 0.0:
            self._meters = {
                name: LevelMeter(1.0 / sensor.rate, sensor.range)
                for name, sensor in self._sensors.items()
                if KINDS[sensor.kind] == SAMPLED
            }
        for meter in self._meters.values():
            meter.turn(window.start, window.end, window.mesh_frequency)
        for name, sensor in self._sensors.items():
            read = window.sensors.get(name)
            if read is not None and len(read.values):
                yield from self._of_sensor(sensor, read)

    def _of_sensor(self, sensor: AnySensor, read: Readings) -> Iterator[SensorMessage]:
        topic, kind = sensor_topic(read.name), KINDS[read.kind]
        if kind == TEMPERATURE:
            for instant, value in zip(read.time, read.values - ZERO_CELSIUS, strict=True):
                fields = {"temperature": float(value), "variance": sensor.noise**2}
                yield SensorMessage(topic, float(instant), fields)
        elif kind == PULSES:
            times = np.asarray(read.values, dtype=np.float64)
            yield SensorMessage(topic, float(times[0]), {"times": times})
        elif kind == ENCODERS and isinstance(sensor, Encoder):
            yield SensorMessage(topic, read.first, _counts(sensor, read))
        else:
            fields = {
                "sample_period": read.period,
                "names": [read.name],
                "units": [read.unit],
                "samples": read.values.astype(np.float32),
            }
            yield SensorMessage(topic, read.first, fields)
            yield from self._levels(read)

    def _levels(self, read: Readings) -> Iterator[SensorMessage]:
        for levels in self._meters[read.name].add(_number(read), read.values):
            fields = levels._asdict() | {"unit": read.unit}
            yield SensorMessage(levels_topic(read.name), fields.pop("end"), fields)


def _number(read: Readings) -> int:
    """Number of the first sample since time 0."""
    return round(read.first / read.period)


def _counts(encoder: Encoder, read: Readings) -> dict[str, Any]:
    """Fields of EncoderBlock: those of an encoder that is not on the output are of the input."""
    own, other = ("output", "input") if encoder.shaft == "output" else ("input", "output")
    return {
        "first_sample": _number(read),
        "sample_period": read.period,
        "absolute": True,
        f"{own}_counts_per_turn": encoder.counts_per_turn,
        f"{other}_counts_per_turn": 0,
        f"{own}_counts": read.values.astype(np.int64),
        f"{other}_counts": np.empty(0, np.int64),
    }
