"""Messages of the sensors of a twin, from the readings of its windows."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ...run.window import Window
from ...scene import Scene
from ...scene.sensors import AnySensor, Encoder, Tachometer, Thermometer
from ...sensors.levels import LevelMeter, Levels
from ...sensors.sensed import Readings
from .sensor_message import CELSIUS, SensorMessage
from .sensor_topics import (
    ENCODERS,
    KINDS,
    PULSES,
    SAMPLED,
    TEMPERATURES,
    levels_topic,
    sensor_topic,
)
from .temperature_messages import TemperatureMessages


def kinds_of(scene: Scene) -> dict[str, str]:
    """Kind of each sensor of a scene by name, and of its temperatures if they are states."""
    kinds: dict[str, str] = {sensor.name: sensor.kind for sensor in scene.sensors}
    return kinds if scene.thermal is None else kinds | {TEMPERATURES: "thermal"}


class SensorMessages:
    """Makes the messages of a run, window by window."""

    def __init__(self, scene: Scene) -> None:
        self._sensors = {sensor.name: sensor for sensor in scene.sensors}
        self._temperatures = TemperatureMessages(scene) if scene.thermal is not None else None
        self.begin()

    def begin(self) -> None:
        """Begin another run of the scene."""
        self._meters = {
            sensor.name: LevelMeter(1.0 / sensor.rate, sensor.range)
            for sensor in self._sensors.values()
            if not isinstance(sensor, (Encoder, Thermometer, Tachometer))
        }
        if self._temperatures is not None:
            self._temperatures.begin()

    def of(self, window: Window) -> Iterator[SensorMessage]:
        """Messages of the next window.

        Yields:
            Messages, those of each topic in the order of time.
        """
        if self._temperatures is not None:
            yield from self._temperatures.of(window)
        for name, readings in window.sensors.items():
            meter = self._meters.get(name)
            if meter is not None:
                meter.turn(window.start, window.end, window.mesh_frequency)
            if not len(readings.values):
                continue
            yield from _messages(self._sensors[name], readings)
            if meter is not None:
                for levels in meter.add(_number(readings), readings.values):
                    yield _message_of_levels(readings, levels)


def _messages(sensor: AnySensor, readings: Readings) -> Iterator[SensorMessage]:
    topic, values = sensor_topic(readings.name), readings.values
    if isinstance(sensor, Thermometer):
        variance = sensor.noise**2
        for time, value in zip(readings.time.tolist(), values.tolist(), strict=True):
            fields = {"temperature": value - CELSIUS, "variance": variance}
            yield SensorMessage(topic, time, fields)
        return
    fields = _FIELDS[KINDS[readings.kind]](sensor, readings)
    yield SensorMessage(topic, float(readings.time[0]), fields)


def _sampled(_: Any, readings: Readings) -> dict[str, Any]:
    return {
        "sample_period": readings.period,
        "names": [readings.name],
        "units": [readings.unit],
        "samples": readings.values.astype(np.float32),
    }


def _encoder(sensor: Any, readings: Readings) -> dict[str, Any]:
    """On the side of its shaft; those on other shafts are sent as input."""
    side, other = ("output", "input") if sensor.shaft == "output" else ("input", "output")
    return {
        "first_sample": _number(readings),
        "sample_period": readings.period,
        f"{side}_counts_per_turn": sensor.counts_per_turn,
        f"{other}_counts_per_turn": 0,
        "absolute": True,  # counts begin at angle 0 in every run
        f"{side}_counts": readings.values.astype(np.int64),
        f"{other}_counts": np.empty(0, np.int64),
    }


def _pulses(_: Any, readings: Readings) -> dict[str, Any]:
    return {"times": readings.values}


_FIELDS = {SAMPLED: _sampled, ENCODERS: _encoder, PULSES: _pulses}


def _message_of_levels(readings: Readings, levels: Levels) -> SensorMessage:
    fields = levels._asdict() | {"unit": readings.unit}
    return SensorMessage(levels_topic(readings.name), fields.pop("end"), fields)


def _number(readings: Readings) -> int:
    """Number of the first sample since time 0."""
    return round(readings.first / readings.period)
