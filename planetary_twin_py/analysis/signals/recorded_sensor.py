"""Signal of a sensor whose blocks of samples are in a recording."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...recording.container.records import RecordingError
from ...recording.ros2.playback import Playback
from ...recording.ros2.sensor_topics import SENSORS
from ...recording.ros2.topics import STATE
from ...recording.runs.block_order import ToTime, since
from ...recording.runs.reader import read_recording
from ...recording.runs.sampled import SampledSensor
from ...recording.runs.sampled_files import Channel, channel_named, channels_of, read_sampled
from ...recording.runs.steadiness import steady_span
from ...recording.tables.sensor import Sensor
from ...recording.tables.sensor_faults import fault_remarks
from ...scene import Scene, parse_scene
from .sensor import sensor_signal
from .signal import Array, Signal, relative_angle, sensor_of_run


class SensorSignal(NamedTuple):
    """A signal of a sensor, and what is known of it."""

    signal: Signal
    """The longest part without a gap."""
    unit: str
    sensor: Sensor | None
    """The samples, if no twin states the angles of the gears."""


class Span(NamedTuple):
    """Part of a recording to read."""

    begin: float | None
    """Start [s]: of simulated time if the recording is of a twin, otherwise since the first sample;
    None is the first sample, or if both are None the start of the longest settled part at one
    operating point of a twin."""
    end: float | None
    """End [s]; None is the last sample, or that of this part."""


def read_sensor_signal(path: Path, name: str, span: Span, scene: Scene | None) -> SensorSignal:
    """Read a signal of a sensor from a recording, or from an .npz file of `simulate`.

    Args:
        path: path of the recording or file.
        name: of the channel, see `channels_of`.
        span: part to read.
        scene: the gears of a measured gearbox; its speed is taken as constant. None: the recorded
            scene, if there is one.

    Raises:
        RecordingError: there is no such sensor, or no samples in the span; or a scene is given for
            a twin.
    """
    if path.suffix == ".npz":
        signal, unit = sensor_of_run(path, name)
        _refuse(path, scene)
        return SensorSignal(signal.within(span.begin, span.end), unit, None)
    counts = Playback(path).counts
    if not any(count and topic.endswith(f"/{STATE}") for topic, count in counts.items()):
        return _without_twin(path, name, span, scene)
    recording = read_recording(path)
    channel = _channel(path, recording.sampled, name)
    if span == Span(None, None) and (steady := steady_span(path)):
        span = Span(*steady)
    signal = _signal(channel, recording.to_time, span, tuple(recording.remarks))
    if channel.sensor.topic.startswith(f"{recording.namespace}/{SENSORS}/"):
        _refuse(path, scene)
        angle = relative_angle(recording, signal.time)
        known = Signal(signal.samples, signal.time, angle, recording.scene_yaml, signal.remarks)
        return SensorSignal(known, channel.unit, None)
    if scene is None and recording.scene_yaml is not None:
        scene = parse_scene(recording.scene_yaml)
    return _measured(name, channel, signal, scene)


def _refuse(path: Path, scene: Scene | None) -> None:
    if scene is not None:
        raise RecordingError(f"{path}: the scene of this twin is recorded; omit --scene")


def _without_twin(path: Path, name: str, span: Span, scene: Scene | None) -> SensorSignal:
    remarks: list[str] = []
    sampled = read_sampled(path, remarks)
    channel = _channel(path, sampled, name)
    to_time = since(min(int(each.order.blocks["stamp"][0]) for each in sampled.values()))
    return _measured(name, channel, _signal(channel, to_time, span, tuple(remarks)), scene)


def _channel(path: Path, sampled: Mapping[str, SampledSensor], name: str) -> Channel:
    return channel_named(path, channels_of(sampled), name)


def _measured(name: str, channel: Channel, signal: Signal, scene: Scene | None) -> SensorSignal:
    """Signal of a measured gearbox, whose speed is that of the scene."""
    sensor = Sensor(name, channel.unit, signal.time, signal.samples, None, signal.remarks)
    return SensorSignal(sensor_signal(sensor, scene), channel.unit, sensor)


def _signal(channel: Channel, to_time: ToTime, span: Span, remarks: tuple[str, ...]) -> Signal:
    """The longest part of a span without a gap, with zero angles."""
    begin = -math.inf if span.begin is None else span.begin
    end = math.inf if span.end is None else span.end
    found = channel.sensor.samples(to_time, begin, end)
    if not len(found.time):
        raise RecordingError(
            f"{channel.sensor.topic}: has no samples from {begin:g} to {end:g} s; "
            f"{_extent(channel.sensor, to_time)}"
        )
    values = found.values[:, channel.number].astype(np.float64)
    remarks += tuple(channel.sensor.order.remarks(to_time))
    whole = Signal(values, found.time, np.zeros(len(values)), None, remarks)
    part = whole.within(span.begin, span.end)
    faults = tuple(fault_remarks(part.time, part.samples))
    return Signal(part.samples, part.time, part.angle, None, part.remarks + faults)


def _extent(sensor: SampledSensor, to_time: ToTime) -> str:
    time: Array = to_time(sensor.order.blocks["stamp"])
    return f"its blocks begin from {time[0]:g} to {time[-1]:g} s"
