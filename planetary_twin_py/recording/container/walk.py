"""All intact records of a file in order, and the damaged parts between them.

If an intact record follows a damaged one, only the damaged one is lost. If none follows, e.g.
after a wrong length or a missing byte, the next intact chunk is searched.
"""

from __future__ import annotations

import os
import zlib
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

from mcap.exceptions import InvalidMagic, McapError
from mcap.opcode import Opcode
from mcap.records import DataEnd
from mcap.stream_reader import CRCValidationError

from .framing import DAMAGED, Piece, next_chunk, opened, piece_at, unpacked_size
from .integrity import MAGIC, end_of_data

_AHEAD = 16 * (os.cpu_count() or 1)  # records; each chunk is followed by an index per topic
_BYTES_AHEAD = 2**25  # of chunks that are decompressed in advance
_OF_SUMMARY = (
    *(Opcode.STATISTICS, Opcode.CHUNK_INDEX, Opcode.ATTACHMENT_INDEX),
    *(Opcode.METADATA_INDEX, Opcode.SUMMARY_OFFSET),
)


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


class Walk:
    """Reads a file once; chunks are decompressed in advance on the other cores."""

    def __init__(self, file: Path, stream: BinaryIO) -> None:
        self._file, self._stream = file, stream
        self._reached = len(MAGIC)
        """Position up to which everything was yielded."""
        self._vouched = len(MAGIC)
        """End of the last intact chunk."""
        self._ended = False

    def __iter__(self) -> Iterator[Sound | Lost | Exception]:
        """Records and damaged parts; last an error after the data, or of their checksum."""
        with ThreadPoolExecutor(os.cpu_count()) as threads:
            while True:
                try:
                    yield from self._in_frames(threads)
                    return
                except DAMAGED as reason:
                    if self._ended:
                        yield reason
                        return
                    size = self._file.stat().st_size
                    resumed = self._resume() or size
                    begin = self._reached if self._reached <= resumed else self._vouched
                    yield Lost(begin, resumed, 0, reason)
                    if resumed == size:
                        return
                    self._reached = self._vouched = resumed

    def _resume(self) -> int | None:
        chunk = next_chunk(self._stream, self._vouched)
        if chunk is None and (end := end_of_data(self._file)) and end >= self._reached:
            return end
        return chunk

    def _in_frames(self, threads: ThreadPoolExecutor) -> Iterator[Sound | Lost]:
        """Records in order; raises one of `DAMAGED` if no intact record follows a damaged one."""
        failed: Lost | None = None
        pieces = _pieces(self._stream, self._reached)
        for piece, open_it in _in_order(pieces, threads):
            try:
                if piece.opcode in _OF_SUMMARY and not self._ended:
                    raise McapError("a summary before the end of the data")
                records = open_it()
            except DAMAGED as reason:
                if failed:
                    raise
                failed = Lost(piece.place, piece.end, piece.opcode, reason)
                continue
            if failed:
                yield failed
                failed = None
            self._reached = piece.end
            if piece.opcode == Opcode.CHUNK:
                self._vouched = piece.end
            self._ended = self._ended or piece.opcode == Opcode.DATA_END
            yield Sound(piece, records)


def _in_order(
    pieces: Iterator[Piece | Exception], threads: ThreadPoolExecutor
) -> Iterator[tuple[Piece, Callable[[], list[Any]]]]:
    """Each record with a function that opens it; threads open the next chunks in advance."""
    waiting: deque[tuple[Piece, Callable[[], list[Any]]]] = deque()
    bytes_ahead = 0
    for piece in pieces:
        if isinstance(piece, Exception):
            yield from waiting
            raise piece
        open_it = partial(opened, piece)
        is_chunk = piece.opcode == Opcode.CHUNK
        bytes_ahead += unpacked_size(piece)
        waiting.append((piece, threads.submit(open_it).result if is_chunk else open_it))
        while len(waiting) > _AHEAD or (waiting and bytes_ahead > _BYTES_AHEAD):
            bytes_ahead -= unpacked_size(waiting[0][0])
            yield waiting.popleft()
    yield from waiting


def _pieces(stream: BinaryIO, begin: int) -> Iterator[Piece | Exception]:
    """Every record from `begin` to the footer; last the exception if the file is truncated.

    The checksum of the data covers all records, so it is verified if all were read.
    """
    stream.seek(begin)
    checksum = zlib.crc32(MAGIC)
    try:
        while True:
            piece = piece_at(stream)
            yield piece
            if piece.opcode == Opcode.DATA_END and begin == len(MAGIC):
                _check(piece, checksum)
            if piece.opcode == Opcode.FOOTER:
                break
            checksum = zlib.crc32(piece.content, zlib.crc32(piece.head, checksum))
        if (magic := stream.read(len(MAGIC))) != MAGIC:
            raise InvalidMagic(magic)
    except DAMAGED as reason:
        yield reason


def _check(piece: Piece, checksum: int) -> None:
    """Raise `CRCValidationError` if the checksum of a Data End record is wrong."""
    if len(piece.content) != 4:
        return  # damaged, which is detected when it is opened
    expected = int.from_bytes(piece.content, "little")
    if expected not in (0, checksum):
        raise CRCValidationError(expected, checksum, DataEnd(expected))
