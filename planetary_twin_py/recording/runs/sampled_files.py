"""Sensors with samples in a recording, also without a twin, and the names that select them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path
from typing import NamedTuple

from mcap.records import Message

from ..container.records import RecordingError, files_of, sections_of
from ..ros2.decode import Topics
from ..ros2.sensor_topics import SAMPLED
from .sampled import SampledSensor
from .waveform import Source


class Channel(NamedTuple):
    """A channel of a sensor."""

    sensor: SampledSensor
    number: int

    @property
    def unit(self) -> str:
        """Unit of its samples."""
        return self.sensor.channels.units[self.number]


def read_sampled(path: Path, remarks: list[str]) -> dict[str, SampledSensor]:
    """Sensors that send blocks of samples, by topic.

    Raises:
        RecordingError: nothing can be read, or the channels of a topic change.
    """
    found: dict[str, SampledSensor] = {}
    for file in files_of(path, remarks):
        topics = Topics(file, lambda topic: False, (SAMPLED,))
        sources: dict[int, Source] = {}
        for section in sections_of(file, remarks):
            messages: dict[int, list[Message]] = {}
            for record in section.records:
                if described := topics.of(record):
                    channel = record.channel_id
                    sources.setdefault(channel, Source(file, channel, described))
                    messages.setdefault(channel, []).append(record)
            for channel, records in messages.items():
                records.sort(key=lambda record: record.log_time)
                topic = sources[channel].described.topic
                sensor = found.setdefault(topic, SampledSensor(topic))
                sensor.add(sources[channel], section.place, records)
    return found


def channels_of(sensors: Mapping[str, SampledSensor]) -> dict[str, Channel]:
    """Channels by the names that select them.

    The name is the last part of the topic, or more parts where topics share it; and the channel, if
    the sensor has several: `ring_top`, `rig.axial`.
    """
    names: dict[str, Channel] = {}
    labels = short_names(sensors)
    for topic, sensor in sensors.items():
        label = labels[topic]
        channels = sensor.channels.names
        for number, channel in enumerate(channels):
            names[label if len(channels) == 1 else f"{label}.{channel}"] = Channel(sensor, number)
    return names


def channel_named(path: Path, names: Mapping[str, Channel], wanted: str) -> Channel:
    """The channel with a name.

    Raises:
        RecordingError: there is none.
    """
    if wanted not in names:
        known = ", ".join(names) or "none: the recording has no samples of a sensor"
        raise RecordingError(f"{path}: sensor = {wanted!r}: must be one of {known}")
    return names[wanted]


def short_names(topics: Collection[str]) -> dict[str, str]:
    """The shortest ends of topics that no other of them has, by topic."""
    return {topic: _label(topic, [other for other in topics if other != topic]) for topic in topics}


def _label(topic: str, others: list[str]) -> str:
    parts = topic.strip("/").split("/")
    for count in range(1, len(parts)):
        label = "/".join(parts[-count:])
        if not any(other.endswith(f"/{label}") for other in others):
            return label
    return topic.strip("/")
