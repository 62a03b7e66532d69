"""Warnings about damaged files: missing bytes, time intervals, chunks and messages."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from mcap.exceptions import UnsupportedCompressionError
from mcap.opcode import Opcode
from mcap.records import Message

from .framing import NO_RECORD, opened
from .walk import Lost, Sound


@dataclass
class _Gap:
    """Losses without a message between them, and the log times [ns] of the messages around them."""

    before: int | None
    losses: list[Lost] = field(default_factory=list)
    indexed: int = 0
    """Messages in the lost chunks, according to their message indexes."""
    after: int | None = None


class Damages:
    """Collects the damage of a file, given its parts in order."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._first: int | None = None  # log time [ns] of the first message
        self._newest: Sequence[Any] = ()  # records of the last section with messages
        self._gaps: list[_Gap] = []
        self._open: _Gap | None = None

    def add(self, part: Sound | Lost) -> None:
        """Add the next part."""
        if isinstance(part, Lost):
            if self._open is None:
                self._open = _Gap(max(_log_times(self._newest), default=None))
                self._gaps.append(self._open)
            self._open.losses.append(part)
            return
        if self._open and part.piece.opcode == Opcode.MESSAGE_INDEX:
            self._open.indexed += len(opened(part.piece, indexes=True)[0].records)
        elif times := _log_times(part.records):
            self._newest = part.records
            self._first = min(times) if self._first is None else self._first
            if self._open:
                self._open.after = min(times)
                self._open = None

    @property
    def unsupported(self) -> Exception | None:
        """The error, if nothing could be read because the compression is unknown."""
        reasons = [lost.reason for gap in self._gaps for lost in gap.losses]
        unknown = [why for why in reasons if isinstance(why, UnsupportedCompressionError)]
        return unknown[0] if unknown and self._first is None else None

    def remarks(self) -> list[str]:
        """A line for each gap, the last of which may be a missing end."""
        return [f"{self._name}: {self._line(gap)}" for gap in self._gaps]

    def _line(self, gap: _Gap) -> str:
        begin, reason = gap.losses[0].place, type(gap.losses[0].reason).__name__
        last = gap.losses[-1]
        if not last.is_last:
            size = sum(lost.end - lost.place for lost in gap.losses)
            return (
                f"damaged{self._span(gap)}: {size} bytes from byte {begin} are skipped "
                f"({_contents(gap)}; {reason})"
            )
        if last.opcode == Opcode.DATA_END:
            return "its data fail their checksum: they may be wrong or incomplete"
        if begin == last.end:
            ending = "has no end record: the recorder is still writing, or was killed"
        else:
            unread = f"the last {last.end - begin} of {last.end} bytes are unreadable"
            ending = f"is truncated, {unread} ({reason})"
        return ending + ("; everything before is intact" if len(self._gaps) == 1 else "")

    def _span(self, gap: _Gap) -> str:
        """Time interval of a gap, relative to the first message of the file."""
        if self._first is None:
            return ""
        if gap.before is None:
            return " before its first message"
        begin, end = (
            "" if time is None else f"{(time - self._first) * 1e-9:.3f}"
            for time in (gap.before, gap.after)
        )
        return f" from {begin} to {end} s" if end else f" from {begin} s"


def _contents(gap: _Gap) -> str:
    """Description of the lost records, as far as it is known."""
    kinds = [lost.opcode for lost in gap.losses]
    if NO_RECORD in kinds:
        return "an unknown number of chunks"
    chunks = kinds.count(Opcode.CHUNK)
    parts = [f"{chunks} chunk{'s' * (chunks > 1)}"] if chunks else []
    parts += [Opcode(kind).name.lower().replace("_", " ") for kind in kinds if kind != Opcode.CHUNK]
    if gap.indexed:
        parts.append(f"{gap.indexed} messages by the index")
    return ", ".join(parts)


def _log_times(records: Sequence[Any]) -> list[int]:
    return [record.log_time for record in records if isinstance(record, Message)]
