"""Adds /clock messages to a recording, from the time stamps of its messages."""

from __future__ import annotations

import struct
from collections.abc import Iterator

from .metadata import Topic
from .playback import Playback, TimedMessage

CLOCK = Topic(name="/clock", type="rosgraph_msgs/msg/Clock", type_hash="", definition="")

_HEADER = "std_msgs/Header"
_STAMP = {0: struct.Struct(">4xiI"), 1: struct.Struct("<4xiI")}  # by the byte order in CDR's head
_LITTLE = b"\0\1\0\0"
_CLOCK = struct.Struct("<4siI")


def with_clock(
    playback: Playback, begin: int, end: int, frequency: float
) -> Iterator[TimedMessage]:
    """Messages of a recording, with /clock messages between them.

    The clock is the newest stamp of the previous headers plus the recorded time since, and never
    decreases. It differs from the recorder's clock if the twin ran faster or slower than real time.
    Without stamps it is the recorder's clock.

    Args:
        playback: the recording.
        begin: start [ns after the first message].
        end: end [ns after the first message].
        frequency: frequency of /clock, per recorded second [Hz].
    """
    ticks = _Ticks(playback, begin, frequency)
    for message in playback.messages(begin, end):
        yield from ticks.until(message.time)
        ticks.update(message)
        yield message
    yield from ticks.until(end + 1)


class _Ticks:
    def __init__(self, playback: Playback, begin: int, frequency: float) -> None:
        self._stamped = _stamped(playback)
        self._anchor = None if self._stamped else (playback.start, 0)
        self._begin = begin
        self._period = 1e9 / frequency
        self._count = 0
        self._newest = 0

    def until(self, instant: int) -> Iterator[TimedMessage]:
        """Clock messages before `instant` [ns]."""
        while (time := self._begin + round(self._count * self._period)) < instant:
            self._count += 1
            if self._anchor is not None:
                stamp, since = self._anchor
                self._newest = max(self._newest, stamp + time - since)
                yield TimedMessage(time, CLOCK.name, _serialized(self._newest))

    def update(self, message: TimedMessage) -> None:
        """Use the stamp of `message` if it is the newest."""
        if message.topic in self._stamped:
            seconds, nanoseconds = _STAMP[message.data[1] & 1].unpack_from(message.data)
            stamp = seconds * 1_000_000_000 + nanoseconds
            if self._anchor is None or stamp >= self._anchor[0]:
                self._anchor = stamp, message.time


def _stamped(playback: Playback) -> set[str]:
    """Topics with a header, of at least half the highest rate; rare ones have other clocks."""
    counts = {
        name: playback.counts[name] for name, topic in playback.topics.items() if _has_header(topic)
    }
    return {name for name, count in counts.items() if 2 * count > max(counts.values())}


def _has_header(topic: Topic) -> bool:
    lines = (line.partition("#")[0].split() for line in topic.definition.splitlines())
    first = next((words for words in lines if words and "=" not in words[1]), [""])
    return first[0] in (_HEADER, "std_msgs/msg/Header", "Header")


def _serialized(time: int) -> bytes:
    return _CLOCK.pack(_LITTLE, *divmod(time, 1_000_000_000))
