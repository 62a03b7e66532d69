"""Sums over the states of a run, for its report: added as they arrive, or read from its files."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from planetary_twin_py.recording.container.records import sections_of
from planetary_twin_py.recording.ros2.decode import Topics
from planetary_twin_py.recording.ros2.topics import STATE


@dataclass
class Sums:
    """Sums over states; `add` takes constant memory for any number of them."""

    states: int = 0
    duration: float = 0.0  # [s] simulated
    lost: float = 0.0  # [J]
    put_in: float = 0.0  # [J] by the machines that drive
    lowest_rate: float = math.inf  # [Hz] of the waveform
    highest_rate: float = -math.inf  # [Hz]

    def add(self, field: Callable[[str], Any]) -> None:
        """Add states; `field` returns the values of a field, of one state or an array of many."""
        interval, rate = np.asarray(field("interval")), field("sample_rate")
        self.states += interval.size
        self.duration += float(np.sum(interval))
        self.lost += float(np.sum(field("power_loss") * interval))
        self.put_in += float(np.sum(driving_power(field) * interval))
        self.lowest_rate = min(self.lowest_rate, float(np.min(rate)))
        self.highest_rate = max(self.highest_rate, float(np.max(rate)))


def driving_power(field: Callable[[str], Any]) -> Any:
    """
    Return the power of the machines that drive in the interval of a state [W].

    Each machine's power has the direction of its mean over the interval. 0 where none drives but
    for rounding errors, which a state shows by its efficiency.
    """
    second = np.nan_to_num(field("second_input_torque") * field("second_input_speed"))
    powers = field("input_power") - second, second, -field("output_power")
    total = sum(np.maximum(power, 0.0) for power in powers)
    return np.where(np.isfinite(field("efficiency")), total, 0.0)


def sums_of(files: Sequence[Path]) -> Sums:
    """Return the sums over all states in recorded `files`, section by section."""
    sums = Sums()
    for file in files:
        topics = Topics(file, lambda topic: topic.endswith(f"/{STATE}"))
        for section in sections_of(file, []):
            messages: dict[int, list[bytes]] = {}
            for record in section.records:
                if topics.of(record):
                    messages.setdefault(record.channel_id, []).append(record.data)
            for channel, data in messages.items():
                for rows in topics.by_channel[channel].arrays(data):
                    sums.add(rows.__getitem__)
    return sums
