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

from mcap.exceptions import EndOfFile
from mcap.opcode import Opcode
from mcap.stream_reader import CRCValidationError

from .framing import DAMAGED, LONGEST_RECORD, Piece, next_chunk, opened, piece_at, record_of
from .integrity import MAGIC, end_of_data

_AHEAD = 2**25  # bytes of chunks that are decompressed in advance
_MOST_AHEAD = 16 * (os.cpu_count() or 1)  # each chunk is followed by an index per topic


class Sound(NamedTuple):
    """An intact record, and its contents."""

    piece: Piece
    records: list[Any]


class Lost(NamedTuple):
    """Unreadable bytes; `opcode` if they are one record, else 0."""

    place: int
    end: int
    opcode: int
    reason: Exception
    is_last: bool = False
    """Whether nothing intact follows."""


def walk(file: Path, stream: BinaryIO) -> Iterator[Sound | Lost]:
    """Every part of the data of a file, read once; other cores decompress chunks in advance.

    Args:
        file: the file.
        stream: its contents.

    Yields:
        Intact and damaged parts up to the end of the data. If only the checksum of all data is
        wrong, the Data End record with it is lost.
    """
    begin: int | None = len(MAGIC)
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        while begin is not None:
            begin = yield from _until_damage(file, stream, begin, threads)


def may_be_written(file: Path) -> bool:
    """Whether a file ends after or within a record before the end of its data, all others intact.

    Args:
        file: MCAP file, perhaps empty.
    """
    with file.open("rb") as stream:
        if (first := stream.read(len(MAGIC))) != MAGIC:
            return MAGIC.startswith(first)
        for part in walk(file, stream):
            if isinstance(part, Lost):
                return part.opcode == 0 and isinstance(part.reason, EndOfFile) and part.is_last
    return False


def _until_damage(
    file: Path, stream: BinaryIO, begin: int, threads: ThreadPoolExecutor
) -> Generator[Sound | Lost, None, int | None]:
    """Records from `begin` to the first damaged one; return where to go on, None at the end."""
    checksum, reached, vouched = zlib.crc32(MAGIC), begin, begin
    for piece, open_it in _in_advance(_pieces(stream, begin), threads):
        try:
            records = open_it()
        except DAMAGED as wrong:
            if piece is not None and _is_intact(stream, piece.end):
                yield Lost(piece.place, piece.end, piece.opcode, wrong)
                return piece.end
            resumed = next_chunk(stream, vouched) or end_of_data(file)
            if resumed is None or resumed < vouched:
                yield Lost(reached, file.stat().st_size, 0, wrong, is_last=True)
                return None
            yield Lost(reached if reached <= resumed else vouched, resumed, 0, wrong)
            return resumed
        assert piece is not None
        if piece.opcode == Opcode.DATA_END and begin == len(MAGIC):
            (end,) = records
            if end.data_section_crc not in (0, checksum):
                reason = CRCValidationError(end.data_section_crc, checksum, end)
                yield Lost(piece.place, piece.end, piece.opcode, reason, is_last=True)
                return None
        yield Sound(piece, records)
        checksum = zlib.crc32(piece.content, zlib.crc32(piece.head, checksum))
        reached = piece.end
        if piece.opcode not in (Opcode.MESSAGE, Opcode.MESSAGE_INDEX):  # whose bytes are unchecked
            vouched = piece.end
    return None


def _is_intact(stream: BinaryIO, place: int) -> bool:
    """Whether an intact record is at a position."""
    stream.seek(place)
    try:
        piece = piece_at(stream)
        opened(piece), record_of(piece.opcode, piece.content)
    except DAMAGED:
        return False
    return True


Opening = tuple[Piece | None, Callable[[], list[Any]]]
"""A record, or None where there is none, and a function that opens it."""


def _in_advance(pieces: Iterator[Opening], threads: ThreadPoolExecutor) -> Iterator[Opening]:
    """The same, while threads open the next chunks."""
    waiting, ahead = deque[Opening](), 0
    for piece, open_it in pieces:
        is_chunk = piece is not None and piece.opcode == Opcode.CHUNK
        waiting.append((piece, threads.submit(open_it).result if is_chunk else open_it))
        ahead += _size(piece)
        while ahead > _AHEAD or len(waiting) > _MOST_AHEAD:
            ahead -= _size(waiting[0][0])
            yield waiting.popleft()
    yield from waiting


def _size(piece: Piece | None) -> int:
    """Bytes of a chunk when it is unpacked, as its header states them; 0 for other records."""
    if piece is None or piece.opcode != Opcode.CHUNK:
        return 0
    return min(int.from_bytes(piece.content[16:24], "little"), LONGEST_RECORD)


def _pieces(stream: BinaryIO, place: int) -> Iterator[Opening]:
    """Records from a position to the end of the data, or to where there is none."""
    while True:
        stream.seek(place)
        try:
            piece = piece_at(stream)
        except DAMAGED as reason:
            yield None, partial(_fail, reason)
            return
        yield piece, partial(opened, piece)
        if piece.opcode in (Opcode.DATA_END, Opcode.FOOTER):
            return
        place = piece.end


def _fail(reason: Exception) -> list[Any]:
    raise reason
