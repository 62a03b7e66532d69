"""The records of a recording, in file order; needs no ROS.

A recording is an MCAP file, or the bag folder that holds one or several. A file torn by a killed
logger still yields every chunk it completed. Checksums are always looked at; chunks are unpacked
ahead on the other cores.
"""

from __future__ import annotations

import os
import struct
import zlib
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

from mcap.data_stream import ReadDataStream
from mcap.exceptions import (
    EndOfFile,
    InvalidMagic,
    McapError,
    RecordLengthLimitExceeded,
    UnsupportedCompressionError,
)
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, DataEnd, Message, Metadata, Schema
from mcap.stream_reader import CRCValidationError, get_chunk_data_stream

from .integrity import MAGIC, damaged_summary

# The longest record a sound recording holds is a chunk of a few MiB: a torn length field may
# claim any size, and nothing near memory's size must be allocated for it.
_LONGEST_RECORD = 256 * 2**20
_HEAD = struct.Struct("<BQ")  # opcode and length of a record
_MESSAGE = struct.Struct("<HIQQ")  # channel, sequence, log time and publish time of a message
_TOLD: dict[int, Any] = {
    Opcode.SCHEMA: Schema,
    Opcode.CHANNEL: Channel,
    Opcode.ATTACHMENT: Attachment,
    Opcode.METADATA: Metadata,
}
_AHEAD = 16 * (os.cpu_count() or 1)  # records; with a chunk come as many as there are topics


class RecordingError(ValueError):
    """The path is no recording, or not one of this gearbox; the message says why in one line."""


class Section(NamedTuple):
    """The records of one chunk, or a single one outside; `place` is where in the file."""

    place: int
    records: list[Any]


def files_of(path: Path) -> list[Path]:
    """The MCAP files of the recording at `path`, in order; raises `RecordingError` without any."""
    if path.is_dir():
        files = sorted(path.glob("*.mcap"), key=lambda file: (len(file.name), file.name))
        if not files:
            raise RecordingError(f"{path}: no recording: the folder holds no .mcap file")
        return files
    if not path.exists():
        raise RecordingError(f"{path}: no such file or folder")
    return [path]


def records_of(file: Path, remarks: list[str]) -> Iterator[Any]:
    """Every schema, channel, message, attachment and metadata; a torn end is told in `remarks`."""
    for section in sections_of(file, remarks):
        yield from section.records


def sections_of(file: Path, remarks: list[str]) -> Iterator[Section]:
    """The same records, section by section."""
    known = _Known()
    sound, ended = len(MAGIC), False
    with file.open("rb") as stream, ThreadPoolExecutor(os.cpu_count()) as threads:
        if stream.read(len(MAGIC)) != MAGIC:
            raise RecordingError(f"{file}: no recording: not an MCAP file")
        try:
            for piece, opened in _in_order(_pieces(stream), threads):
                ended = ended or piece.opcode == Opcode.DATA_END  # what follows only repeats
                records = [] if ended else known.described(opened())
                sound = piece.end
                if records:
                    yield Section(piece.place, records)
            if remark := _at_the_end(file, ended):
                remarks.append(remark)
        except UnsupportedCompressionError as missing:
            raise RecordingError(f"{file}: {missing}") from None
        except TORN as reason:
            remarks.append(_torn(file, sound, reason))
    if known.strays:
        remarks.append(
            f"{file.name}: {known.strays} messages are of topics whose description is lost"
        )


class _Known:
    """The topics described so far; counts messages of others in `strays`."""

    def __init__(self) -> None:
        self._schemas: set[int] = set()
        self._channels: set[int] = set()
        self.strays = 0

    def described(self, records: list[Any]) -> list[Any]:
        """`records` but channels without a schema, and messages without a channel."""
        return [record for record in records if self._is_described(record)]

    def _is_described(self, record: Any) -> bool:
        if isinstance(record, Message):
            known = record.channel_id in self._channels
            self.strays += not known
            return known
        if isinstance(record, Schema):
            self._schemas.add(record.id)
        elif isinstance(record, Channel):
            if record.schema_id not in self._schemas:
                return False
            self._channels.add(record.id)
        return True


def _at_the_end(file: Path, ended: bool) -> str:
    """What is not sound of a file that is there to its end."""
    if not ended:
        return f"{file.name}: the end of its data is not marked; some may be missing"
    return f"{file.name}: its summary is damaged" if damaged_summary(file) else ""


def _torn(file: Path, sound: int, reason: Exception) -> str:
    if isinstance(reason, CRCValidationError) and isinstance(reason.record, DataEnd):
        return f"{file.name}: its data fail their checksum: what was read may be wrong or lacking"
    size = file.stat().st_size
    if sound == size:
        return (
            f"{file.name}: has no end record, the recorder was stopped before it could finish; "
            "everything before is sound"
        )
    return (
        f"{file.name}: ends torn, the last {size - sound} of {size} bytes "
        f"are not readable ({type(reason).__name__}); everything before is sound"
    )


def section_at(file: Path, place: int) -> list[Any]:
    """The records of the section that `sections_of` has found at `place`."""
    with file.open("rb") as stream:
        stream.seek(place)
        return _opened(_piece(stream))


def chunk_at(file: Path, place: int) -> list[Any]:
    """The records of the chunk that an index tells of; raises one of `TORN` where there is none."""
    with file.open("rb") as stream:
        stream.seek(place)
        piece = _piece(stream)
    if piece.opcode != Opcode.CHUNK:
        raise McapError(f"no chunk at {place}")
    return _opened(piece)


class _Piece(NamedTuple):
    """A record as it stands in the file."""

    place: int
    opcode: int
    content: bytes
    head: bytes

    @property
    def end(self) -> int:
        return self.place + _HEAD.size + len(self.content)


def _in_order(
    pieces: Iterator[_Piece | Exception], threads: ThreadPoolExecutor
) -> Iterator[tuple[_Piece, Callable[[], list[Any]]]]:
    """Each record with what opens it, which the threads have begun to do for those that come."""
    waiting: deque[tuple[_Piece, Callable[[], list[Any]]]] = deque()
    for piece in pieces:
        if isinstance(piece, Exception):
            yield from waiting
            raise piece
        open_it = partial(_opened, piece)
        large = piece.opcode == Opcode.CHUNK
        waiting.append((piece, threads.submit(open_it).result if large else open_it))
        if len(waiting) > _AHEAD:
            yield waiting.popleft()
    yield from waiting


def _pieces(stream: BinaryIO) -> Iterator[_Piece | Exception]:
    """Every record up to the footer; the last is the exception where the file is torn."""
    checksum = zlib.crc32(MAGIC)
    try:
        while True:
            piece = _piece(stream)
            if piece.opcode == Opcode.DATA_END:
                _check(piece, checksum)
            yield piece
            if piece.opcode == Opcode.FOOTER:
                break
            checksum = zlib.crc32(piece.content, zlib.crc32(piece.head, checksum))
        if (magic := stream.read(len(MAGIC))) != MAGIC:
            raise InvalidMagic(magic)
    except TORN as reason:
        yield reason


def _piece(stream: BinaryIO) -> _Piece:
    place = stream.tell()
    head = stream.read(_HEAD.size)
    if len(head) < _HEAD.size:
        raise EndOfFile
    opcode, length = _HEAD.unpack(head)
    if length > _LONGEST_RECORD:
        raise RecordLengthLimitExceeded(opcode, length, _LONGEST_RECORD)
    content = stream.read(length)
    if len(content) < length:
        raise EndOfFile
    return _Piece(place, opcode, content, head)


def _check(piece: _Piece, checksum: int) -> None:
    end = DataEnd.read(_fields(piece.content))
    if end.data_section_crc not in (0, checksum):
        raise CRCValidationError(end.data_section_crc, checksum, end)


def _opened(piece: _Piece) -> list[Any]:
    """What a record of the file tells: those that a chunk holds, or itself, or nothing."""
    if piece.opcode == Opcode.CHUNK:
        return _unpacked(Chunk.read(_fields(piece.content)))
    kind = _TOLD.get(piece.opcode)
    return [kind.read(_fields(piece.content))] if kind else []


def _unpacked(chunk: Chunk) -> list[Any]:
    """The records that a chunk holds."""
    if chunk.uncompressed_size > _LONGEST_RECORD:
        raise RecordLengthLimitExceeded(Opcode.CHUNK, chunk.uncompressed_size, _LONGEST_RECORD)
    try:
        stream, size = get_chunk_data_stream(chunk, validate_crc=True)
    except RuntimeError as reason:  # of lz4
        raise McapError(str(reason)) from None
    data = stream.read(size)
    records: list[Any] = []
    end = 0
    while end < size:
        opcode, length = _HEAD.unpack_from(data, end)
        begin = end + _HEAD.size
        end = begin + length
        if end > size or (opcode == Opcode.MESSAGE and length < _MESSAGE.size):
            raise EndOfFile
        if opcode == Opcode.MESSAGE:
            channel, sequence, log_time, publish_time = _MESSAGE.unpack_from(data, begin)
            content = data[begin + _MESSAGE.size : end]
            records.append(Message(channel, log_time, content, publish_time, sequence))
        elif kind := _TOLD.get(opcode):
            records.append(kind.read(_fields(data[begin:end])))
    return records


def _fields(content: bytes) -> ReadDataStream:
    return ReadDataStream(BytesIO(content))


def _torn_errors() -> tuple[type[Exception], ...]:
    """What a record cut in the middle raises: at its end, in its fields, in its compressed data."""
    errors: tuple[type[Exception], ...] = (
        *(McapError, struct.error, ValueError, EOFError),
        *(MemoryError, OverflowError),  # of a length that cannot be
    )
    try:
        import zstandard
    except ImportError:
        return errors
    return (*errors, zstandard.ZstdError)


TORN = _torn_errors()
