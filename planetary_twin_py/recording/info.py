"""What a recording holds: topics with their rates and losses, and what was changed when."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from mcap.records import Channel, Message, Metadata, Schema

from ..scene import TUNABLES
from .bag import ACCOUNT_RECORD
from .decode import Decoder
from .records import files_of, records_of
from .repeats import Seen, unrepeated
from .topics import POINT, REAL_TIME, STATE

REPORT = "/diagnostics"


@dataclass
class TopicInfo:
    """One topic; `first` and `last` are log times [ns]."""

    type: str
    recorded: int = 0
    lost: int | None = None
    """Messages published but not received, by the recorder's account; None without one."""
    first: int = 0
    last: int = 0
    longest_gap: int = 0
    """Between two messages [ns]."""

    @property
    def rate(self) -> float:
        """Messages per second of log time; NaN with fewer than two."""
        span = self.last - self.first
        return (self.recorded - 1) / (span * 1e-9) if span > 0 else math.nan

    def take(self, log_time: int) -> None:
        """Count a message."""
        if self.recorded:
            self.longest_gap = max(self.longest_gap, log_time - self.last)
        else:
            self.first = log_time
        self.last = max(self.last, log_time)
        self.recorded += 1


class Changed(NamedTuple):
    """Values of an operating point that are new, and the simulated instant [s]."""

    time: float
    namespace: str
    values: Mapping[str, float]


@dataclass
class Info:
    """What `read_info` has found; `remarks` says in lines what could not be read."""

    files: list[Path]
    topics: dict[str, TopicInfo] = field(default_factory=dict)
    changes: list[Changed] = field(default_factory=list)
    simulated: float = 0.0
    """Simulated time that all gearbox states together cover [s]."""
    report: dict[str, str] = field(default_factory=dict)
    """Figures of the simulation's last report in /diagnostics."""
    remarks: list[str] = field(default_factory=list)

    def figures(self) -> dict[str, Any]:
        """For machines, as those of a run."""
        topics = {
            name: {
                "type": topic.type,
                "published": topic.recorded + (topic.lost or 0),
                "recorded": topic.recorded,
                "lost": topic.lost,
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
            "file": str(self.files[0]),
        }


def read_info(path: Path) -> Info:
    """Read the recording at `path`: an .mcap file or a folder of them.

    Raises:
        RecordingError: there is none.
    """
    info = Info(files_of(path))
    points: dict[str, Any] = {}
    lost: Counter[str] = Counter()
    seen: Seen = set()
    for file in info.files:
        decoder = Decoder(_tells)
        schemas: dict[int, Schema] = {}
        names: dict[int, str] = {}
        for record in unrepeated(records_of(file, info.remarks), seen):
            if isinstance(record, Schema):
                schemas[record.id] = record
            elif isinstance(record, Channel):
                names[record.id] = record.topic
                info.topics.setdefault(record.topic, TopicInfo(schemas[record.schema_id].name))
            elif isinstance(record, Message):
                info.topics[names[record.channel_id]].take(record.log_time)
            elif isinstance(record, Metadata) and record.name == ACCOUNT_RECORD:
                lost[record.metadata["topic"]] += int(record.metadata["lost"])
            if found := decoder.read(record):
                _learn(info, points, *found)
    # A file may tell of a topic before the first chunk that has its channel.
    for name in info.topics.keys() & lost.keys():
        info.topics[name].lost = lost[name]
    return info


def _tells(topic: str) -> bool:
    """Whether messages of a topic are read, not only counted."""
    return topic == REPORT or topic.endswith((f"/{STATE}", f"/{POINT}"))


def _learn(info: Info, points: dict[str, Any], topic: str, message: Any) -> None:
    """What a message tells of the run."""
    if topic.endswith(f"/{STATE}"):
        info.simulated += message.interval
    elif topic == REPORT:
        for status in message.status:
            if status.name == REAL_TIME:
                info.report |= {item.key: item.value for item in status.values}
    else:
        last = points.get(topic)
        values = {name: getattr(message, name) for name in TUNABLES}
        new = {k: v for k, v in values.items() if last is None or v != last[k]}
        points[topic] = values
        info.changes.append(Changed(message.simulated_time, topic.removesuffix(f"/{POINT}"), new))
