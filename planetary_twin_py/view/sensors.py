"""Sensors that send blocks of samples: ranges for an overview, and samples in detail."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..recording.ros2.sensor_topics import SENSORS
from ..recording.runs.reader import Recording
from ..recording.runs.sampled_files import Channel, channels_of
from ..recording.runs.waveform import TimeSpan
from . import timeline
from .detail import first_rows
from .layer import Layer
from .plots import log_series

PLACE = "sensors"
COLOUR = (120, 190, 150)
_CHUNK = 50_000  # samples per chunk; the viewer loads only visible chunks


class Shown(NamedTuple):
    """A channel of a sensor in a view."""

    name: str
    """That selects it, see `channels_of`."""
    channel: Channel
    of_twin: bool
    """Whether it is one of the twin, whose angles are those of its gears."""

    @property
    def path(self) -> str:
        """Parent of its entities."""
        return f"{PLACE}/{self.name.replace('/', '_')}"


def sensors_of(recording: Recording) -> list[Shown]:
    """The channels of the sensors in a recording."""
    own = f"{recording.namespace}/{SENSORS}/"
    return [
        Shown(name, channel, channel.sensor.topic.startswith(own))
        for name, channel in channels_of(recording.sampled).items()
    ]


def log_sensors(layer: Layer, recording: Recording, detail: list[TimeSpan]) -> Iterator[str]:
    """Log ranges at /sensors/NAME/range and samples at /sensors/NAME/waveform; yield warnings.

    Args:
        layer: recording to draw into.
        recording: recording to draw.
        detail: time spans [s] of the samples.
    """
    for shown in sensors_of(recording):
        _log_ranges(layer, recording, shown, detail)
        step = _CHUNK / shown.channel.sensor.rate
        for begin, end in detail:
            for first in np.arange(begin, end, step):
                _log_samples(layer, recording, shown, first, min(first + step, end))
    for sensor in recording.sampled.values():
        yield from sensor.order.remarks(recording.to_time)


def _log_ranges(layer: Layer, recording: Recording, shown: Shown, detail: list[TimeSpan]) -> None:
    sensor, number, unit = shown.channel.sensor, shown.channel.number, shown.channel.unit
    stamp = sensor.order.blocks["stamp"].astype(np.int64)
    time = recording.to_time(stamp)
    begins = first_rows(time, detail)
    low, high = sensor.ranges[:, number].T.astype(np.float64)
    values = np.column_stack((np.fmin.reduceat(low, begins), np.fmax.reduceat(high, begins)))
    index = timeline.columns(time[begins], stamp[begins])
    names = [f"{shown.name} {end} [{unit}]" for end in ("min", "max")]
    log_series(layer, f"{shown.path}/range", index, values, names, [COLOUR, COLOUR])


def _log_samples(
    layer: Layer, recording: Recording, shown: Shown, first: float, last: float
) -> None:
    found = shown.channel.sensor.samples(recording.to_time, first, last)
    part = (first <= found.time) & (found.time < last)
    index = timeline.columns(found.time[part], found.stamp[part])
    values = found.values[part, shown.channel.number].astype(np.float64)
    names = [f"{shown.name} [{shown.channel.unit}]"]
    log_series(layer, f"{shown.path}/waveform", index, values[:, None], names, [COLOUR])
