"""What a recording contains: topics with rates and losses, changes, sensors, last states."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from ..container.integrity import end_of_data
from ..container.message_index import LogTimes
from .last_states import LastDamage, LastTemperatures
from .sampled_info import SampledInfo


@dataclass
class TopicInfo(LogTimes):
    """One topic, and the log times of its messages."""

    type: str = ""
    lost: int | None = None
    """Messages published but not received, by the recorder's account, and recorded ones that cannot
    be read; None without an account, or if files of the recording are missing."""
    before: int = 0
    """Lost messages that were published before the first received one."""

    @property
    def rate(self) -> float:
        """Messages per second of log time; NaN with fewer than two."""
        span = self.last - self.first
        return (self.recorded - 1) / (span * 1e-9) if span > 0 else math.nan


class Changed(NamedTuple):
    """Changed values of operating point and ports, and their simulated time [s]."""

    time: float
    namespace: str
    values: Mapping[str, Any]


@dataclass
class Info:
    """Result of `read_info`; `remarks` are warnings about unreadable parts."""

    files: list[Path]
    topics: dict[str, TopicInfo] = field(default_factory=dict)
    changes: list[Changed] = field(default_factory=list)
    simulated: float = 0.0
    """Total simulated time of all gearbox states [s]."""
    report: dict[str, str] = field(default_factory=dict)
    """Values of the last report of the simulation in /diagnostics."""
    remarks: list[str] = field(default_factory=list)
    sampled: dict[str, SampledInfo] = field(default_factory=dict)
    """Sensors that send blocks of samples, by topic."""
    damage: dict[str, LastDamage] = field(default_factory=dict)
    """Last damage of each gearbox, by topic."""
    temperatures: dict[str, LastTemperatures] = field(default_factory=dict)
    """Last temperatures of each gearbox, by topic."""

    @property
    def skips(self) -> int:
        """Number of skips of stamps that were late, see the parameter `max_lag`."""
        return int(self.report.get("skips", 0))

    @property
    def skipped(self) -> float:
        """ROS time [s] between stamps for which the gearbox was not simulated."""
        return float(self.report.get("skipped", 0.0))

    @property
    def is_empty(self) -> bool:
        """Whether all files are finished, but have no messages, nor topics without damage."""
        if any(topic.recorded for topic in self.topics.values()):
            return False
        whole = bool(self.topics) and not self.remarks
        return not whole and all(end_of_data(file) is not None for file in self.files)

    def figures(self) -> dict[str, Any]:
        """Results for `--json`."""
        topics = {
            name: {
                "type": topic.type,
                "published": topic.recorded + (topic.lost or 0),
                "recorded": topic.recorded,
                "lost": topic.lost,
                "before": topic.before,
                "rate_hz": None if math.isnan(topic.rate) else topic.rate,
                "longest_gap_s": topic.longest_gap * 1e-9,
            }
            for name, topic in self.topics.items()
        }
        factor = self.report.get("real_time_factor_mean")
        overruns = self.report.get("overruns")
        return {
            "topics": topics,
            "duration_s": self.simulated,
            "real_time_factor": None if factor is None else float(factor),
            "overruns": None if overruns is None else int(overruns),
            "skips": self.skips,
            "skipped_s": self.skipped,
            "damage": {name: damage._asdict() for name, damage in self.damage.items()},
            "temperatures": {name: last._asdict() for name, last in self.temperatures.items()},
            "sensors": {name: sensor.figures() for name, sensor in self.sampled.items()},
            "file": str(self.files[0]),
        }
