"""All intact records of a file in order, and the damaged parts between them.

After a damaged record, reading continues with the next one, or if it is not intact, either, e.g.
after a wrong length or a missing byte, with the next intact chunk.
"""

from __future__ import annotations

import os
import zlib
from collections import deque
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

from mcap.opcode import Opcode
from mcap.stream_reader import CRCValidationError

from .framing import DAMAGED, LONGEST_RECORD, NO_RECORD, Piece, next_chunk, opened, piece_at
from .integrity import MAGIC, end_of_data

_AHEAD = 2**25  # bytes of chunks that are decompressed in advance
_MOST_AHEAD = 16 * (os.cpu_count() or 1)  # each chunk is followed by an index per topic


class Sound(NamedTuple):
    """An intact record, and its contents."""

    piece: Piece
    records: list[Any]


class Lost(NamedTuple):
    """Unreadable bytes; `opcode` if they are one record, else `NO_RECORD`."""

    place: int
    end: int
    opcode: int
    reason: Exception
    is_last: bool = False
    """Whether nothing intact follows."""


def walk(file: Path, stream: BinaryIO) -> Iterator[Sound | Lost]:
    """Every part of the data of a file, read once; other cores decompress chunks in advance.

    Yields:
        Intact and damaged parts up to the end of the data. If only the checksum of all data is
        wrong, the Data End record with it is lost.
    """
    begin: int | None = len(MAGIC)
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        while begin is not None:
            begin = yield from _until_damage(file, stream, begin, threads)


def _until_damage(
    file: Path, stream: BinaryIO, begin: int, threads: ThreadPoolExecutor
) -> Generator[Sound | Lost, None, int | None]:
    """Records from `begin` to the first damaged one; return where to go on, None at the end."""
    checksum, vouched = zlib.crc32(MAGIC), begin
    for piece, open_it in _in_advance(_pieces(stream, begin), threads):
        try:
            records = open_it()
        except DAMAGED as wrong:
            resumed = _resumed(file, stream, piece, vouched)
            end = file.stat().st_size if resumed is None else resumed
            opcode = piece.opcode if resumed == piece.end else NO_RECORD
            yield Lost(min(piece.place, end), end, opcode, wrong, resumed is None)
            return resumed
        if piece.opcode == Opcode.DATA_END and begin == len(MAGIC):
            (end_of_all,) = records
            if end_of_all.data_section_crc not in (0, checksum):
                reason = CRCValidationError(end_of_all.data_section_crc, checksum, end_of_all)
                yield Lost(piece.place, piece.end, piece.opcode, reason, is_last=True)
                return None
        yield Sound(piece, records)
        checksum = zlib.crc32(piece.content, zlib.crc32(piece.head, checksum))
        if piece.opcode not in (Opcode.MESSAGE, Opcode.MESSAGE_INDEX):  # whose bytes are unchecked
            vouched = piece.end
    return None


def _resumed(file: Path, stream: BinaryIO, damaged: Piece, vouched: int) -> int | None:
    """Where reading continues after a damaged record, not before `vouched`; None at the end."""
    stream.seek(damaged.end)
    try:
        if damaged.opcode != NO_RECORD and opened(piece_at(stream), indexes=True):
            return damaged.end
    except DAMAGED:
        pass
    found = next_chunk(stream, vouched) or end_of_data(file)
    return found if found is not None and found >= vouched else None


Opening = tuple[Piece, Callable[[], list[Any]]]
"""A record, and a function that opens it."""


def _in_advance(pieces: Iterator[Piece], threads: ThreadPoolExecutor) -> Iterator[Opening]:
    """Records in order, while threads open the next chunks."""
    waiting, ahead = deque[Opening](), 0
    for piece in pieces:
        is_chunk, open_it = piece.opcode == Opcode.CHUNK, partial(opened, piece)
        waiting.append((piece, threads.submit(open_it).result if is_chunk else open_it))
        ahead += _unpacked_size(piece)
        while ahead > _AHEAD or len(waiting) > _MOST_AHEAD:
            ahead -= _unpacked_size(waiting[0][0])
            yield waiting.popleft()
    yield from waiting


def _unpacked_size(piece: Piece) -> int:
    """Bytes of a chunk when it is unpacked, as its header states them; 0 for other records."""
    if piece.opcode != Opcode.CHUNK:
        return 0
    return min(int.from_bytes(piece.content[16:24], "little"), LONGEST_RECORD)


def _pieces(stream: BinaryIO, place: int) -> Iterator[Piece]:
    """Records from a position to the end of the data, or to where there is none."""
    while True:
        stream.seek(place)
        piece = piece_at(stream)
        yield piece
        if piece.opcode in (NO_RECORD, Opcode.DATA_END):
            return
        place = piece.end
