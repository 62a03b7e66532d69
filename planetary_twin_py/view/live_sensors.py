"""Sensors of a running twin: samples and ranges of their blocks, as they arrive."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..recording.runs.simulated_time import SimulatedTime
from ..recording.runs.waveform import stamps
from . import timeline
from .layer import Layer
from .sensors import SensorPage, log_ranges, log_samples


class LiveBlock(NamedTuple):
    """A block of samples of a sensor of the twin."""

    topic: str
    message: NDArray[Any]
    """One row."""

    @property
    def stamp(self) -> int:
        """ROS time of the first sample [ns]."""
        return int(stamps(self.message)[0])


class LiveSensors:
    """Draws the sensors of a run.

    Args:
        layer: recording to draw into.
    """

    def __init__(self, layer: Layer) -> None:
        self._layer = layer
        self.pages: list[SensorPage] = []
        """Of the sensors drawn so far."""

    def draw(self, blocks: list[LiveBlock], states: list[NDArray[Any]]) -> bool:
        """Draw blocks; returns whether there is another sensor.

        Args:
            blocks: of one channel each, not after the last state.
            states: messages of GearboxState that tell the simulated time, at least one.
        """
        known = len(self.pages)
        time, interval = (
            np.concatenate([state[name] for state in states]).astype(np.float64)
            for name in ("simulated_time", "interval")
        )
        stamp = np.concatenate([stamps(state) for state in states])
        to_time = SimulatedTime(stamp, time, interval)
        for block in blocks:
            self._draw(block, to_time)
        return len(self.pages) > known

    def _draw(self, block: LiveBlock, to_time: SimulatedTime) -> None:
        (row,) = block.message
        period, values = float(row["sample_period"]), row["samples"].astype(np.float64)
        page = self._page(block.topic, row["units"].item()[0], period)
        offset = period * np.arange(len(values))
        stamp = block.stamp + np.rint(1e9 * offset).astype(np.int64)
        index = timeline.columns(to_time(stamp[:1]) + offset, stamp)
        log_samples(self._layer, page, index, values)
        first = timeline.columns(to_time(stamp[:1]), stamp[:1])
        log_ranges(self._layer, page, first, values.min(keepdims=True), values.max(keepdims=True))

    def _page(self, topic: str, unit: bytes, period: float) -> SensorPage:
        name = topic.rpartition("/")[2]
        text = unit.rstrip(b"\0").decode(errors="replace")
        page = SensorPage(name, text, 1.0 / period, of_twin=True, spectra=False)
        if page not in self.pages:
            self.pages.append(page)
        return page
