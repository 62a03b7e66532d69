"""What is missing of a damaged file, in lines: bytes, stretch of time, chunks and messages."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mcap.exceptions import UnsupportedCompressionError
from mcap.opcode import Opcode
from mcap.records import Message

from .framing import indexed_messages
from .walk import Lost, Sound


@dataclass
class _Stretch:
    """Losses without a message between them; log times [ns] of the messages on either side."""

    before: int | None
    losses: list[Lost] = field(default_factory=list)
    indexed: int = 0
    """Messages that were in the lost chunks, by the indexes behind these."""
    after: int | None = None


class Damages:
    """Follows what is read of a file, and what is lost."""

    def __init__(self, file: Path) -> None:
        self._file = file
        self._size = file.stat().st_size
        self._first: int | None = None  # log time [ns] of the first message
        self._newest: Sequence[Any] = ()  # records of the last section with messages
        self._stretches: list[_Stretch] = []
        self._open: _Stretch | None = None
        self.reached = 0
        """End of the last sound record."""

    def lose(self, lost: Lost) -> None:
        """Take what cannot be read; it comes after all that was seen."""
        if self._open is None:
            self._open = _Stretch(max(_log_times(self._newest), default=None))
            self._stretches.append(self._open)
        self._open.losses.append(lost)

    def see(self, sound: Sound) -> None:
        """Take what was read."""
        self.reached = sound.piece.end
        if self._open and sound.piece.opcode == Opcode.MESSAGE_INDEX:
            self._open.indexed += indexed_messages(sound.piece)
        if sound.records and isinstance(sound.records[-1], Message):
            self._newest = sound.records
            if self._first is None:
                self._first = min(_log_times(sound.records))
            if self._open:
                self._open.after = min(_log_times(sound.records))
                self._open = None

    @property
    def unsupported(self) -> Exception | None:
        """Why nothing could be read, where that is a compression that is not known here."""
        reasons = [lost.reason for stretch in self._stretches for lost in stretch.losses]
        unknown = [why for why in reasons if isinstance(why, UnsupportedCompressionError)]
        return unknown[0] if unknown and self._first is None else None

    def remarks(self) -> list[str]:
        """A line for each stretch, and for an end that is missing."""
        return [self._line(stretch) for stretch in self._stretches]

    def _line(self, stretch: _Stretch) -> str:
        last = stretch.losses[-1]
        if last.end == self._size and last.opcode == 0:
            return self._torn(stretch)
        begin = stretch.losses[0].place
        size = sum(lost.end - lost.place for lost in stretch.losses)
        return (
            f"{self._file.name}: damaged{self._span(stretch)}: {size} bytes from byte {begin} on "
            f"are left out ({_contents(stretch)}; {type(stretch.losses[0].reason).__name__})"
        )

    def _torn(self, stretch: _Stretch) -> str:
        begin = stretch.losses[0].place
        before = "everything before is sound" if len(self._stretches) == 1 else ""
        if begin == self._size:
            found = "has no end record, the recorder was stopped before it could finish"
        else:
            found = (
                f"ends torn, the last {self._size - begin} of {self._size} bytes are not readable "
                f"({type(stretch.losses[0].reason).__name__})"
            )
        return f"{self._file.name}: {'; '.join(filter(None, (found, before)))}"

    def _span(self, stretch: _Stretch) -> str:
        """The stretch of time after the first message of the file."""
        if self._first is None:
            return ""
        begin, end = (
            None if time is None else f"{(time - self._first) * 1e-9:.3f}"
            for time in (stretch.before, stretch.after)
        )
        if begin is None:
            return " before its first message"
        return f" from {begin} to {end} s" if end else f" from {begin} s on"


def _contents(stretch: _Stretch) -> str:
    """What is lost, as far as that is known."""
    kinds = [lost.opcode for lost in stretch.losses]
    if 0 in kinds:
        return "an unknown number of chunks"
    chunks = kinds.count(Opcode.CHUNK)
    parts = [f"{chunks} chunk{'s' * (chunks > 1)}"] if chunks else []
    names = {int(kind): kind.name.lower().replace("_", " ") for kind in Opcode}
    parts += [names.get(kind, "record") for kind in kinds if kind != Opcode.CHUNK]
    if stretch.indexed:
        parts.append(f"{stretch.indexed} messages by the index")
    return ", ".join(parts)


def _log_times(records: Sequence[Any]) -> list[int]:
    return [record.log_time for record in records if isinstance(record, Message)]
