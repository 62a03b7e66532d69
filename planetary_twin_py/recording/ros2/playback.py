"""A recording for replay: serialised messages in order of time; needs no ROS."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import NamedTuple

from mcap.records import Channel, Message, Schema

from ..container.extent import Extent
from ..container.log_order import merged
from ..container.records import RecordingError, files_of
from ..container.segment import Segment
from .metadata import Topic, read_offered_qos
from .no_run import no_run_yet
from .repeats import Repeats


class TimedMessage(NamedTuple):
    """A serialised message; `time` [ns] is its log time after the recording's first message."""

    time: int
    topic: str
    data: bytes


class Playback:
    """The messages of a recording, which may be truncated or damaged.

    Attributes:
        topics: topics by name.
        counts: number of messages by topic.
        start: log time of the first message of any topic [ns].
        length: time from the first to the last message [ns].
        remarks: warnings about a missing run and unreadable parts; it grows while a damaged file is
            read.

    Args:
        path: path of an .mcap file, or a folder of them.
        chosen: topics to play; all if empty.

    Raises:
        RecordingError: there is nothing to play.
    """

    def __init__(self, path: Path, chosen: Collection[str] = ()) -> None:
        self.remarks: list[str] = []
        self.topics: dict[str, Topic] = {}
        self.counts: Counter[str] = Counter()
        extent = Extent()
        files = files_of(path, self.remarks)
        segments = [Segment(file, self._add_remark) for file in files]
        recorded = {channel.topic for segment in segments for channel, _ in segment.channels}
        for name in chosen:
            if name not in recorded:
                raise RecordingError(f"topics: {name}: {path} has {', '.join(sorted(recorded))}")
        for segment in segments:
            for channel, schema in segment.channels:
                if not chosen or channel.topic in chosen:
                    self._add(channel, schema, path)
            self.counts += segment.counts
            if segment.extent.start:
                extent.include(segment.extent.start)
                extent.include(segment.extent.end)
        self.counts.update(dict.fromkeys(recorded, 0))
        chunks = [(chunk, segment) for segment in segments for chunk in segment.chunks]
        self._chunks = sorted(chunks, key=lambda pair: pair[0].start)
        no_run = no_run_yet(path, self.counts)
        if not extent.start:
            raise RecordingError(no_run or f"{path}: has no messages")
        if no_run:
            self._add_remark(no_run)
        self.start = extent.start
        self.length = extent.end - extent.start

    def messages(self, begin: int = 0, end: int | None = None) -> Iterator[TimedMessage]:
        """Messages from `begin` to `end` [ns after the first message] in order of log time.

        The newest messages of latched topics before `begin`, which a late subscriber receives, are
        first.
        """
        repeats, first = Repeats(), self.start + begin
        for topic, message in self._latched(first):
            if not repeats.known(topic, message):
                yield TimedMessage(begin, topic, message.data)
        for topic, message in merged(self._parts(first)):
            if end is not None and message.log_time > self.start + end:
                return
            if not (self.topics[topic].kept and repeats.known(topic, message)):
                yield TimedMessage(message.log_time - self.start, topic, message.data)

    def _parts(self, first: int) -> Iterator[tuple[int, list[tuple[int, tuple[str, Message]]]]]:
        """Messages at or after log time `first` [ns], chunk by chunk of any file."""
        for chunk, segment in self._chunks:
            if chunk.end < first:
                continue
            wanted = [
                (topic, message)
                for topic, message in segment.read(chunk)
                if message.log_time >= first and topic in self.topics
            ]
            yield chunk.start, [(pair[1].log_time, pair) for pair in wanted]

    def _latched(self, before: int) -> list[tuple[str, Message]]:
        """Latched messages that are valid at a log time [ns], oldest first."""
        missing = Counter({name: topic.kept for name, topic in self.topics.items()})
        found: list[tuple[str, Message]] = []
        for chunk, segment in reversed(self._chunks):
            missing = +missing
            if not missing:
                break
            if chunk.start < before and segment.may_have(chunk, missing):
                for topic, message in reversed(segment.read(chunk)):
                    if missing[topic] > 0 and message.log_time < before:
                        missing[topic] -= 1
                        found.append((topic, message))
        found.reverse()
        return sorted(found, key=lambda pair: pair[1].log_time)

    def _add(self, channel: Channel, schema: Schema | None, path: Path) -> None:
        if schema is None or channel.message_encoding != "cdr":
            raise RecordingError(
                f"{path}: {channel.topic}: its encoding {channel.message_encoding!r} must be that "
                "of ROS 2 messages, 'cdr', with a schema"
            )
        offered_qos = read_offered_qos(channel.metadata.get("offered_qos_profiles", ""))
        topic = Topic(
            name=channel.topic,
            type=schema.name,
            type_hash=channel.metadata.get("topic_type_hash", ""),
            definition=schema.data.decode(errors="replace"),
            offered_qos=offered_qos,
        )
        known = self.topics.setdefault(channel.topic, topic)
        if known.type != schema.name:
            raise RecordingError(
                f"{path}: {channel.topic}: has two types, {known.type} and {schema.name}"
            )

    def _add_remark(self, remark: str) -> None:
        if remark not in self.remarks:
            self.remarks.append(remark)
