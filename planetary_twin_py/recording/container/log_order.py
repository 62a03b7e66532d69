"""The records of a file with its messages in the order of their log times.

A recorder writes messages nearly in this order. Tools that merge, filter or sort files may write
them in another, for example topic by topic.
"""

from __future__ import annotations

import heapq
import struct
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, TypeVar

from mcap.opcode import Opcode
from mcap.records import Channel, Message

from .integrity import MAGIC
from .records import Section, section_at, sections_of

DISORDER = 1_000_000_000
"""Log time [ns] by which messages of a recorder are at most out of order."""
_HEAD = struct.Struct("<BQ")  # opcode and length of a record
_CHUNK = struct.Struct("<Q")  # log time of the first message of a chunk, 0 without messages
_MESSAGE = struct.Struct("<6xQ")  # log time of a message
T = TypeVar("T")


def records_in_log_order(file: Path, remarks: list[str]) -> Iterator[Any]:
    """All intact records as of `records_of`; messages in the order of their log times.

    Yields:
        Records of `mcap`. A channel is before its messages.

    Raises:
        RecordingError: nothing can be read.
    """
    yield from merged(_reached(_sections(file, remarks)))


def merged(parts: Iterable[tuple[int, Iterable[tuple[int, T]]]]) -> Iterator[T]:
    """Items of several parts in the order of their times; of those at the same time, as given.

    Args:
        parts: items after their times, and the time before which neither this part nor a later one
            has items.
    """
    waiting: list[tuple[int, int, T]] = []
    number = 0
    for reached, items in parts:
        while waiting and waiting[0][0] < reached:
            yield heapq.heappop(waiting)[2]
        for time, item in items:
            number += 1
            heapq.heappush(waiting, (time, number, item))
    while waiting:
        yield heapq.heappop(waiting)[2]


def _reached(sections: Iterable[Section]) -> Iterator[tuple[int, list[tuple[int, Any]]]]:
    """Records after their log times, and the time before which no later section has messages."""
    newest = 0
    for _, records in sections:
        timed = [(each.log_time if isinstance(each, Message) else 0, each) for each in records]
        newest = max(newest, min((time for time, _ in timed if time), default=0))
        yield newest - DISORDER, timed


def _sections(file: Path, remarks: list[str]) -> Iterator[Section]:
    """All sections as of `sections_of`, none later by more than `DISORDER` than one after it.

    A file in another order is read twice: first everything but the messages.
    """
    if _is_in_log_order(file):
        yield from sections_of(file, remarks)
        return
    places: list[tuple[int, int]] = []  # first log time and position
    channels: set[int] = set()
    for place, records in sections_of(file, remarks):
        times = [record.log_time for record in records if isinstance(record, Message)]
        if times:
            places.append((min(times), place))
        others = [record for record in records if not isinstance(record, Message)]
        channels |= {record.id for record in others if isinstance(record, Channel)}
        if others:
            yield Section(place, others)
    for _, place in sorted(places):
        messages = [
            record
            for record in section_at(file, place)
            if isinstance(record, Message) and record.channel_id in channels
        ]
        yield Section(place, messages)


def _is_in_log_order(file: Path) -> bool:
    """Whether no section begins more than `DISORDER` before one that it follows.

    Only heads of records are read, up to the end of the data or to the first that is damaged.
    """
    newest, size = 0, file.stat().st_size
    with file.open("rb") as stream:
        stream.seek(len(MAGIC))
        while len(head := stream.read(_HEAD.size)) == _HEAD.size:
            opcode, length = _HEAD.unpack(head)
            end = stream.tell() + length
            if opcode in (Opcode.CHUNK, Opcode.MESSAGE):
                form = _CHUNK if opcode == Opcode.CHUNK else _MESSAGE
                if len(content := stream.read(form.size)) < form.size:
                    return True
                (begin,) = form.unpack(content)
                if begin and begin < newest - DISORDER:
                    return False
                newest = max(newest, begin)
            if end > size or opcode not in tuple(Opcode) or opcode == Opcode.DATA_END:
                return True
            stream.seek(end)
    return True
