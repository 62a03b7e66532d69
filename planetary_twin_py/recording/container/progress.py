"""Whether a recorder may still be writing a file."""

from __future__ import annotations

from pathlib import Path

from mcap.exceptions import EndOfFile
from mcap.opcode import Opcode

from .framing import DAMAGED, opened, piece_at
from .integrity import MAGIC


def may_be_written(file: Path) -> bool:
    """Whether a file ends after or within a record before the end of its data, all others intact.

    Args:
        file: MCAP file, perhaps empty.
    """
    with file.open("rb") as stream:
        if not MAGIC.startswith(stream.read(len(MAGIC))):
            return False
        while True:
            try:
                piece = piece_at(stream)
            except EndOfFile:
                return True
            except DAMAGED:
                return False
            try:
                opened(piece)
            except DAMAGED:
                return False
            if piece.opcode in (Opcode.DATA_END, Opcode.FOOTER):
                return False
