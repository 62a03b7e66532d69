"""Sensors that send blocks of samples: ranges for an overview, and samples in detail."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from ..recording.ros2.sensor_topics import SENSORS
from ..recording.runs.reader import Recording
from ..recording.runs.sampled_files import Channel, channels_of
from ..recording.runs.waveform import TimeSpan
from . import timeline
from .detail import first_rows
from .layer import Layer
from .plots import log_series

Array = NDArray[np.float64]
PLACE = "sensors"
COLOUR = (120, 190, 150)
_CHUNK = 50_000  # samples per chunk; the viewer loads only visible chunks


class SensorPage(NamedTuple):
    """What the page of a channel of a sensor shows."""

    name: str
    """That selects it, see `channels_of`."""
    unit: str
    rate: float
    """Sample rate [Hz]."""
    of_twin: bool
    """Whether it is one of the twin, whose angles are those of its gears."""
    spectra: bool = True
    """Whether there are spectra."""

    @property
    def path(self) -> str:
        """Parent of its entities."""
        return f"{PLACE}/{self.name.replace('/', '_')}"


class Shown(NamedTuple):
    """A channel of a sensor in a view."""

    page: SensorPage
    channel: Channel

    @property
    def path(self) -> str:
        """Parent of its entities."""
        return self.page.path


def sensors_of(recording: Recording) -> list[Shown]:
    """The channels of the sensors in a recording."""
    own = f"{recording.namespace}/{SENSORS}/"
    return [
        Shown(
            SensorPage(name, of.unit, of.sensor.rate, of.sensor.topic.startswith(own)),
            of,
        )
        for name, of in channels_of(recording.sampled).items()
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


def log_samples(layer: Layer, page: SensorPage, index: list[rr.TimeColumn], values: Array) -> None:
    """Log samples at /sensors/NAME/waveform.

    Args:
        layer: recording to draw into.
        page: of the sensor.
        index: time columns, n rows.
        values: in the unit of the sensor, (n,).
    """
    names = [f"{page.name} [{page.unit}]"]
    log_series(layer, f"{page.path}/waveform", index, values[:, None], names, [COLOUR])


def log_ranges(
    layer: Layer, page: SensorPage, index: list[rr.TimeColumn], low: Array, high: Array
) -> None:
    """Log the smallest and the largest samples of blocks at /sensors/NAME/range.

    Args:
        layer: recording to draw into.
        page: of the sensor.
        index: time columns, n rows.
        low: smallest samples, (n,).
        high: largest samples, (n,).
    """
    names = [f"{page.name} {end} [{page.unit}]" for end in ("min", "max")]
    values = np.column_stack((low, high))
    log_series(layer, f"{page.path}/range", index, values, names, [COLOUR, COLOUR])


def _log_ranges(layer: Layer, recording: Recording, shown: Shown, detail: list[TimeSpan]) -> None:
    sensor, number = shown.channel
    stamp = sensor.order.blocks["stamp"].astype(np.int64)
    time = recording.to_time(stamp)
    begins = first_rows(time, detail)
    low, high = sensor.ranges[:, number].T.astype(np.float64)
    index = timeline.columns(time[begins], stamp[begins])
    ends = np.fmin.reduceat(low, begins), np.fmax.reduceat(high, begins)
    log_ranges(layer, shown.page, index, *ends)


def _log_samples(
    layer: Layer, recording: Recording, shown: Shown, first: float, last: float
) -> None:
    found = shown.channel.sensor.samples(recording.to_time, first, last)
    part = (first <= found.time) & (found.time < last)
    index = timeline.columns(found.time[part], found.stamp[part])
    log_samples(layer, shown.page, index, found.values[part, shown.channel.number].astype(float))
