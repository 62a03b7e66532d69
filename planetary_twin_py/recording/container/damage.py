"""Warnings about damaged files: missing bytes, time intervals, chunks and messages."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mcap.exceptions import UnsupportedCompressionError
from mcap.opcode import Opcode
from mcap.records import Message

from .framing import record_of
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
    """Collects the damage of a file while it is read."""

    def __init__(self, file: Path) -> None:
        self._file = file
        self._first: int | None = None  # log time [ns] of the first message
        self._newest: Sequence[Any] = ()  # records of the last section with messages
        self._gaps: list[_Gap] = []
        self._open: _Gap | None = None

    def add_lost(self, lost: Lost) -> None:
        """Add an unreadable part, which follows the parts added before."""
        if self._open is None:
            self._open = _Gap(max(_log_times(self._newest), default=None))
            self._gaps.append(self._open)
        self._open.losses.append(lost)

    def add_sound(self, sound: Sound) -> None:
        """Add an intact record."""
        if self._open and sound.piece.opcode == Opcode.MESSAGE_INDEX:
            self._open.indexed += len(record_of(*sound.piece[1:]).records)
        if times := _log_times(sound.records):
            self._newest = sound.records
            if self._first is None:
                self._first = min(times)
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
        return [self._line(gap) for gap in self._gaps]

    def _line(self, gap: _Gap) -> str:
        last = gap.losses[-1]
        if last.opcode == Opcode.DATA_END and last.is_last:
            return (
                f"{self._file.name}: its data fail their checksum: they may be wrong or incomplete"
            )
        if last.is_last:
            return self._truncated(gap, last.end)
        begin = gap.losses[0].place
        size = sum(lost.end - lost.place for lost in gap.losses)
        return (
            f"{self._file.name}: damaged{self._span(gap)}: {size} bytes from byte {begin} "
            f"are skipped ({_contents(gap)}; {type(gap.losses[0].reason).__name__})"
        )

    def _truncated(self, gap: _Gap, size: int) -> str:
        begin = gap.losses[0].place
        before = "everything before is intact" if len(self._gaps) == 1 else ""
        if begin == size:
            ending = "has no end record: the recorder is still writing, or was killed"
        else:
            ending = (
                f"is truncated, the last {size - begin} of {size} bytes are unreadable "
                f"({type(gap.losses[0].reason).__name__})"
            )
        return f"{self._file.name}: {'; '.join(filter(None, (ending, before)))}"

    def _span(self, gap: _Gap) -> str:
        """Time interval of a gap, relative to the first message of the file."""
        if self._first is None:
            return ""
        begin, end = (
            None if time is None else f"{(time - self._first) * 1e-9:.3f}"
            for time in (gap.before, gap.after)
        )
        if begin is None:
            return " before its first message"
        return f" from {begin} to {end} s" if end else f" from {begin} s"


def _contents(gap: _Gap) -> str:
    """Description of the lost records, as far as it is known."""
    kinds = [lost.opcode for lost in gap.losses]
    if 0 in kinds:
        return "an unknown number of chunks"
    chunks = kinds.count(Opcode.CHUNK)
    parts = [f"{chunks} chunk{'s' * (chunks > 1)}"] if chunks else []
    names = {int(kind): kind.name.lower().replace("_", " ") for kind in Opcode}
    parts += [names.get(kind, "record") for kind in kinds if kind != Opcode.CHUNK]
    if gap.indexed:
        parts.append(f"{gap.indexed} messages by the index")
    return ", ".join(parts)


def _log_times(records: Sequence[Any]) -> list[int]:
    return [record.log_time for record in records if isinstance(record, Message)]
