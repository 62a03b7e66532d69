"""Reads a recording to plain arrays; needs no ROS."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from mcap.records import Attachment, Channel, Message
from numpy.typing import NDArray

from ...text.escaping import one_line
from ..container.records import RecordingError, files_of, sections_of
from ..ros2.decode import Described, Topics
from ..ros2.namespaces import choose_namespace
from ..ros2.no_run import no_run_yet
from ..ros2.repeats import Repeats
from ..ros2.sensor_topics import SAMPLED, is_beside
from ..ros2.topics import AXES_STATE, AXES_WAVEFORM, ORIGIN, POINT, STATE, WAVEFORM
from ..ros2.typestore import absent
from .origin import scene_of_origin
from .sampled import SampledSensor
from .series import Series, planets_in, series_of
from .simulated_time import SimulatedTime
from .waveform import (
    AxesSamples,
    Blocks,
    InFile,
    InMemory,
    RangedBlocks,
    Ranges,
    Source,
    TimeSpan,
    Waveform,
    WaveformInFile,
    WaveformInMemory,
    joined,
    last_times,
)

SCENE_ATTACHMENT = "scene.yaml"
SERIES = (STATE, POINT, AXES_STATE)
"""Topics whose messages are kept in memory, as columns."""
TOPICS = (*SERIES, WAVEFORM, AXES_WAVEFORM)
_LONGEST = 300  # characters of a remark


@dataclass
class Recording:
    """The messages of one gearbox; `remarks` are warnings about unreadable parts.

    States are in memory; samples are read from the file on demand.
    """

    path: Path
    namespace: str
    planets: int
    state: Series
    operating_point: Series
    blocks: RangedBlocks
    axes_state: Series
    """States of axes that move; without rows where they are held."""
    axes_blocks: Blocks[AxesSamples]
    scene_yaml: str | None = None
    remarks: list[str] = field(default_factory=list)
    topics: frozenset[str] = frozenset()
    """Names of all topics in the files."""
    sampled: Mapping[str, SampledSensor] = field(default_factory=dict)
    """Sensors of the twin, and of a measured gearbox, that send blocks of samples, by topic."""
    complete: bool = True
    """False if states after the last one were not read, see `read_recording`."""

    @cached_property
    def ranges(self) -> Ranges | None:
        """Smallest and largest sample of each block; None without mesh_waveform."""
        return self.blocks.ranges()

    @cached_property
    def waveform(self) -> Waveform | None:
        """Every sample of the recording, read on first access.

        At 50 kHz and six meshes this takes 4 MB per second; use `samples` for long recordings.
        """
        return self.samples(-math.inf, math.inf)

    def samples(self, begin: float, end: float) -> Waveform | None:
        """Read the samples of all blocks that overlap a time span.

        Args:
            begin: start [s of simulated time].
            end: end [s of simulated time].

        Returns:
            The samples; None if there is no such block.

        Raises:
            OSError: the file no longer exists.
        """
        return self.blocks.samples(begin, end)

    def within(self, spans: Sequence[TimeSpan]) -> Recording:
        """Recording with only the samples of these time spans [s], in memory."""
        waveform = joined([self.samples(begin, end) for begin, end in spans])
        axes = joined([self.axes_blocks.samples(begin, end) for begin, end in spans])
        return replace(self, blocks=WaveformInMemory(waveform), axes_blocks=InMemory(axes))

    @cached_property
    def to_time(self) -> SimulatedTime:
        """Gives the simulated time of stamps."""
        state = self.state
        return SimulatedTime(state.stamp, state.time, state["interval"])

    @property
    def moves_axes(self) -> bool:
        """Whether axes move."""
        return len(self.axes_state) > 0

    @property
    def meshes(self) -> tuple[str, ...]:
        """Names of the meshes, in the order of the waveform's columns."""
        return tuple(
            f"{kind}_{i + 1}" for kind in ("sun_planet", "planet_ring") for i in range(self.planets)
        )

    def per_mesh(self, name: str) -> NDArray[np.float64]:
        """A per-mesh quantity of GearboxState, e.g. "dte_mean", shape (messages, meshes)."""
        pair = [
            self.state[f"{kind}_{name}"][:, : self.planets]
            for kind in ("sun_planet", "planet_ring")
        ]
        return np.concatenate(pair, axis=1)


def read_recording(
    path: str | Path,
    namespace: str | None = None,
    most: int | None = None,
    span: TimeSpan = (-math.inf, math.inf),
) -> Recording:
    """Read a recording.

    Args:
        path: path of an .mcap file, or a folder of them.
        namespace: namespace of the gearbox; None if there is only one.
        most: number of states after which reading stops, because all are kept in memory; None
            reads all.
        span: time span [s of simulated time] of the states and samples to read.

    Raises:
        RecordingError: there is nothing to read, or no state in `span`.
    """
    path = Path(path)
    collected = _Collector(math.inf if most is None else most, span)
    for file in files_of(path, collected.remarks):
        if collected.complete:
            collected.read(file)
    counts = collected.counts()
    namespace = choose_namespace(counts, namespace, path)
    collected.remarks += filter(None, [no_run_yet(path, counts)])
    series = {name: series_of(name, collected.taken(f"{namespace}/{name}")) for name in SERIES}
    if not len(series[STATE]):
        raise RecordingError(f"{path}: has no state from {span[0]:g} to {span[1]:g} s")
    waveform, axes_waveform = f"{namespace}/{WAVEFORM}", f"{namespace}/{AXES_WAVEFORM}"
    return Recording(
        path=path,
        namespace=namespace,
        planets=planets_in(series[STATE], path, namespace),
        state=series[STATE],
        operating_point=series[POINT],
        blocks=collected.blocks.get(waveform, WaveformInFile()),
        axes_state=series[AXES_STATE],
        axes_blocks=collected.axes_blocks.get(axes_waveform, InFile(AxesSamples)),
        scene_yaml=collected.scene_yaml
        or _scene(collected.taken(f"{namespace}/{ORIGIN}"), collected.remarks),
        remarks=collected.remarks,
        topics=frozenset(collected.topics),
        sampled={k: v for k, v in collected.sampled.items() if is_beside(k, namespace)},
        complete=collected.complete,
    )


def _scene(origins: list[NDArray[Any]], remarks: list[str]) -> str | None:
    """YAML of the scene of the newest run with a readable origin."""
    for text in reversed([bytes(data) for rows in origins for data in rows["data"]]):
        try:
            return scene_of_origin(text.decode())
        except (RecordingError, UnicodeDecodeError) as reason:
            remarks.append(one_line(f"{ORIGIN}: {reason}", _LONGEST))
    return None


def _is_read(topic: str) -> bool:
    return topic.rpartition("/")[2] in (*TOPICS, ORIGIN)


class _Collector:
    """Collects structured arrays and waveform blocks of files, by topic.

    `complete` is false after `most` states. States and blocks outside `span` [s] are left out.
    """

    def __init__(self, most: float, span: TimeSpan) -> None:
        self.complete = True
        self._room = most
        self._begin, self._end = span
        self._seen: Counter[str] = Counter()
        self._parts: dict[str, list[tuple[int, NDArray[Any]]]] = {}
        self.blocks: dict[str, WaveformInFile] = {}
        self.axes_blocks: dict[str, InFile[AxesSamples]] = {}
        self.sampled: dict[str, SampledSensor] = {}
        self.scene_yaml: str | None = None
        self.remarks: list[str] = []
        self.topics: set[str] = set()
        self._repeats = Repeats()

    def read(self, file: Path) -> None:
        """Read a file."""
        topics = Topics(file, _is_read, (SAMPLED,))
        sources: dict[int, Source] = {}
        self._repeats.next_file()
        for section in sections_of(file, self.remarks):
            messages: dict[int, list[Message]] = {}
            for record in section.records:
                if isinstance(record, Channel):
                    self.topics.add(record.topic)
                if self._repeats.repeated(record):
                    continue
                if isinstance(record, Attachment) and record.name == SCENE_ATTACHMENT:
                    self.scene_yaml = self.scene_yaml or record.data.decode(errors="replace")
                elif described := topics.of(record):
                    channel = record.channel_id
                    if channel not in sources:
                        sources[channel] = Source(file, channel, described)
                        self._remark_absent(described)
                    messages.setdefault(channel, []).append(record)
            for channel, found in messages.items():
                self._add(sources[channel], section.place, found)
            if self._room < 0:
                self.complete = False
                return

    def taken(self, topic: str) -> list[NDArray[Any]]:
        """The messages of a topic, in the order of log times; they are no longer kept here."""
        parts = sorted(self._parts.pop(topic, []), key=lambda part: part[0])
        return [rows for _, rows in parts]

    def counts(self) -> dict[str, int]:
        """Messages by topic, also outside the span; 1 for topics that are not read."""
        return {topic: self._seen[topic] if _is_read(topic) else 1 for topic in self.topics}

    def _remark_absent(self, topic: Described) -> None:
        fields = absent(topic.kind, topic.fields)
        remark = f"{topic.topic}: recorded by another version, without {', '.join(fields)}"
        if fields and remark not in self.remarks:
            self.remarks.append(remark)

    def _add(self, source: Source, place: int, messages: list[Message]) -> None:
        name = source.described.topic
        topic = name.rpartition("/")[2]
        messages.sort(key=lambda message: message.log_time)
        begin = messages[0].log_time
        if source.described.kind == SAMPLED:
            self.sampled.setdefault(name, SampledSensor(name)).add(source, place, messages)
            return
        for every in source.described.arrays([message.data for message in messages]):
            self._seen[name] += len(every)
            rows = self._within(topic, every)
            self._room -= len(rows) if topic == STATE else 0
            if not len(rows):
                continue
            if topic == WAVEFORM:
                self.blocks.setdefault(name, WaveformInFile()).add(source, place, rows)
            elif topic == AXES_WAVEFORM:
                blocks = self.axes_blocks.setdefault(name, InFile(AxesSamples))
                blocks.add(source, place, rows)
            else:
                self._parts.setdefault(name, []).append((begin, rows))

    def _within(self, topic: str, rows: NDArray[Any]) -> NDArray[Any]:
        """The rows whose times overlap the span; all of operating points."""
        if topic in (WAVEFORM, AXES_WAVEFORM):
            rows = rows[rows["samples"] > 0]
            first, last = rows["start_time"], last_times(rows)
        elif topic in (STATE, AXES_STATE):
            first = last = rows["simulated_time"]
        else:
            return rows
        return rows[(first <= self._end) & (last >= self._begin)]
