"""A recording as it is played again: serialised messages at their instants; needs no ROS."""

from __future__ import annotations

import heapq
from collections import deque
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

import yaml
from mcap.reader import make_reader
from mcap.records import Channel, Message, Schema, Statistics
from mcap.summary import Summary

from .records import TORN, RecordingError, files_of, records_of
from .repeats import Seen, unrepeated
from .rosbag2 import Extent, Topic

# Messages stand in a file in the order a recorder got to them: far less than this apart.
_DISORDER = 1_000_000_000  # [ns]


class Cue(NamedTuple):
    """A serialised message; `time` [ns] is its log time after the tape's first message."""

    time: int
    topic: str
    data: bytes


class Tape:
    """What there is to play at `path`: an .mcap file, also a torn one, or a folder of them.

    `topics` by name; `length` [ns] from the first message to the last; `remarks` says in lines
    what could not be read, and grows while a damaged file is played.
    Raises `RecordingError` where there is nothing to play.
    """

    def __init__(self, path: Path) -> None:
        self.remarks: list[str] = []
        self.topics: dict[str, Topic] = {}
        self._files = files_of(path)
        self._extent = Extent()
        for file in self._files:
            self._index(file)
        if not self._extent.start:
            raise RecordingError(f"{path}: holds no message")

    @property
    def length(self) -> int:
        """From the first message to the last [ns]."""
        return self._extent.end - self._extent.start

    def cues(self, begin: int = 0, end: int | None = None) -> Iterator[Cue]:
        """Messages from `begin` to `end` [ns after the first message] in the order of log time.

        Before them, at `begin`, come the messages a subscriber joining then would still get:
        the newest ones of latched topics.
        """
        latched = {
            name: deque[Cue](maxlen=topic.kept) for name, topic in self.topics.items() if topic.kept
        }
        for cue in _in_order(self._read()):
            if cue.time < begin:
                if cue.topic in latched:
                    latched[cue.topic].append(cue)
                continue
            yield from _newest(latched.values(), begin)
            latched.clear()
            if end is not None and cue.time > end:
                return
            yield cue

    def _read(self) -> Iterator[Cue]:
        """Every message, in file order."""
        seen: Seen = set()
        for file in self._files:
            remarks: list[str] = []
            names: dict[int, str] = {}
            for record in unrepeated(records_of(file, remarks), seen):
                if isinstance(record, Channel):
                    names[record.id] = record.topic
                elif isinstance(record, Message):
                    time = record.log_time - self._extent.start
                    yield Cue(time, names[record.channel_id], record.data)
            self.remarks += [remark for remark in remarks if remark not in self.remarks]

    def _index(self, file: Path) -> None:
        """Learn topics and extent: from the summary, or from every record of a torn file."""
        summary, statistics = _summary(file)
        if summary is not None and statistics is not None:
            for channel in summary.channels.values():
                self._add(channel, summary.schemas, file)
            if statistics.message_count:
                self._extent.include(statistics.message_start_time)
                self._extent.include(statistics.message_end_time)
            return
        schemas: dict[int, Schema] = {}
        for record in records_of(file, self.remarks):
            if isinstance(record, Schema):
                schemas[record.id] = record
            elif isinstance(record, Channel):
                self._add(record, schemas, file)
            elif isinstance(record, Message):
                self._extent.include(record.log_time)

    def _add(self, channel: Channel, schemas: dict[int, Schema], file: Path) -> None:
        schema = schemas.get(channel.schema_id)
        if schema is None or channel.message_encoding != "cdr":
            raise RecordingError(
                f"{file}: {channel.topic} is encoded as {channel.message_encoding or 'nothing'}, "
                "only ROS 2 messages (cdr) can be played"
            )
        known = self.topics.setdefault(channel.topic, _topic(channel, schema))
        if known.type != schema.name:
            raise RecordingError(
                f"{file}: {channel.topic} holds both {known.type} and {schema.name}"
            )


def _summary(file: Path) -> tuple[Summary | None, Statistics | None]:
    """What a finished file says of itself; nothing where it was torn before it could."""
    with file.open("rb") as stream:
        try:
            summary = make_reader(stream).get_summary()
        except TORN:
            return None, None
    return summary, summary.statistics if summary else None


def _topic(channel: Channel, schema: Schema) -> Topic:
    return Topic(
        name=channel.topic,
        type=schema.name,
        type_hash=channel.metadata.get("topic_type_hash", ""),
        definition=schema.data.decode(),
        offered_qos=yaml.safe_load(channel.metadata.get("offered_qos_profiles", "")) or [],
    )


def _in_order(cues: Iterable[Cue]) -> Iterator[Cue]:
    """The same sorted by time, equal times in their given order; holds a second of them."""
    waiting: list[tuple[int, int, Cue]] = []
    newest = 0
    for number, cue in enumerate(cues):
        heapq.heappush(waiting, (cue.time, number, cue))
        newest = max(newest, cue.time)
        while waiting[0][0] < newest - _DISORDER:
            yield heapq.heappop(waiting)[2]
    while waiting:
        yield heapq.heappop(waiting)[2]


def _newest(latched: Iterable[Iterable[Cue]], begin: int) -> list[Cue]:
    earlier = sorted((cue for cues in latched for cue in cues), key=lambda cue: cue.time)
    return [cue._replace(time=begin) for cue in earlier]
