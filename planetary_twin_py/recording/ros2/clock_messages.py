"""The time that a recording's messages are stamped with, as messages of /clock among them."""

from __future__ import annotations

import struct
from collections.abc import Iterator

from .metadata import Topic
from .tape import Cue, Tape

CLOCK = Topic(name="/clock", type="rosgraph_msgs/msg/Clock", type_hash="", definition="")

_HEADER = "std_msgs/Header"
_STAMP = {0: struct.Struct(">4xiI"), 1: struct.Struct("<4xiI")}  # by the byte order in CDR's head
_LITTLE = b"\0\1\0\0"
_CLOCK = struct.Struct("<4siI")


def with_clock(tape: Tape, begin: int, end: int, frequency: float) -> Iterator[Cue]:
    """The tape's cues, and between them /clock, `frequency` [Hz] times per recorded second.

    It tells the newest stamp in the headers that came before, plus the recorded time since, and
    never goes back: a recorder's own time is another one where the twin ran faster or slower than
    real time. Without stamps in the recording it tells the recorder's time.
    """
    ticks = _Ticks(tape, begin, frequency)
    for cue in tape.cues(begin, end):
        yield from ticks.until(cue.time)
        ticks.see(cue)
        yield cue
    yield from ticks.until(end + 1)


class _Ticks:
    def __init__(self, tape: Tape, begin: int, frequency: float) -> None:
        self._stamped = _stamped(tape)
        self._anchor = None if self._stamped else (tape.start, 0)
        self._begin = begin
        self._period = 1e9 / frequency
        self._count = 0
        self._told = 0

    def until(self, instant: int) -> Iterator[Cue]:
        """What is to be told before `instant` [ns]."""
        while (time := self._begin + round(self._count * self._period)) < instant:
            self._count += 1
            if self._anchor is not None:
                stamp, since = self._anchor
                self._told = max(self._told, stamp + time - since)
                yield Cue(time, CLOCK.name, _serialized(self._told))

    def see(self, cue: Cue) -> None:
        """Go by the stamp of `cue`, where it is the newest."""
        if cue.topic in self._stamped:
            seconds, nanoseconds = _STAMP[cue.data[1] & 1].unpack_from(cue.data)
            stamp = seconds * 1_000_000_000 + nanoseconds
            if self._anchor is None or stamp >= self._anchor[0]:
                self._anchor = stamp, cue.time


def _stamped(tape: Tape) -> set[str]:
    """Topics with a header that come about as often as any: rare ones are stamped by others."""
    counts = {name: tape.counts[name] for name, topic in tape.topics.items() if _has_header(topic)}
    return {name for name, count in counts.items() if 2 * count > max(counts.values())}


def _has_header(topic: Topic) -> bool:
    lines = (line.partition("#")[0].split() for line in topic.definition.splitlines())
    first = next((words for words in lines if words and "=" not in words[1]), [""])
    return first[0] in (_HEADER, "std_msgs/msg/Header", "Header")


def _serialized(time: int) -> bytes:
    return _CLOCK.pack(_LITTLE, *divmod(time, 1_000_000_000))
