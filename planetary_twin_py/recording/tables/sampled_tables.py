"""Tables of sensors that send blocks of samples: a row per sample, each block once."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..ros2.topics import STATE
from ..runs.block_order import ToTime, since
from ..runs.sampled import SampledSensor
from ..runs.series import column
from ..runs.simulated_time import SimulatedTime
from ..runs.waveform import stamps
from .message_rows import MESSAGES, rows_of
from .message_tables import STAMP, Batch, Column


def time_axis(path: Path, namespace: str, sensors: list[SampledSensor]) -> ToTime:
    """Simulated time of stamps; without a twin, seconds since the first sample of any sensor.

    Args:
        path: path of the recording.
        namespace: of the twin.
        sensors: all sensors, at least one.
    """
    parts = [rows for _, each in rows_of(path, namespace, [STATE], []) for rows in each]
    if not parts:
        return since(min(int(sensor.order.blocks["stamp"][0]) for sensor in sensors))
    time, interval = (column(n, [p[n] for p in parts]) for n in ("simulated_time", "interval"))
    return SimulatedTime(np.concatenate([stamps(rows) for rows in parts]), time, interval)


def batches(sensor: SampledSensor, to_time: ToTime) -> Iterator[Batch]:
    """Columns of successive samples: stamps, time, and each channel."""
    for found in sensor.parts(to_time, MESSAGES):
        values = zip(sensor.channels.names, found.values.T, strict=True)
        yield {STAMP: found.stamp, "time": found.time, **dict(values)}


def columns(sensor: SampledSensor, batch: Batch) -> list[Column]:
    """The columns of a batch with their units."""
    units = {STAMP: "ns", "time": "s", **dict(zip(*sensor.channels, strict=True))}
    return [Column(name, units[name], values.dtype) for name, values in batch.items()]
