"""The records of an MCAP file with their positions, read by mcap's classes; whole ones only.

mcap's `StreamReader` ends at the first damaged record, and skips what a wrong length adds to one.
"""

from __future__ import annotations

import mmap
import re
import struct
import zlib
from dataclasses import replace
from io import BytesIO
from typing import Any, BinaryIO, NamedTuple

import lz4.frame
import zstandard
from mcap import records
from mcap.data_stream import ReadDataStream
from mcap.exceptions import (
    EndOfFile,
    McapError,
    RecordLengthLimitExceeded,
    UnsupportedCompressionError,
)
from mcap.opcode import Opcode
from mcap.records import Attachment, Chunk, Message
from mcap.stream_reader import get_chunk_data_stream

LONGEST_RECORD = 256 * 2**20
"""Bytes; a chunk of a recording has some MiB. A damaged length may have any value."""
NO_RECORD = 0
"""Opcode of a piece where there is no whole record."""
_HEAD = struct.Struct("<BQ")  # opcode and length of a record
_MESSAGE = struct.Struct("<HIQQ")  # channel, sequence, log time and publish time of a message
_ZSTD = b"\x28\xb5\x2f\xfd"  # with which no plain CDR begins
_KINDS: dict[int, Any] = {
    kind: getattr(records, kind.name.title().replace("_", "")) for kind in Opcode
}
# Head, times, size, checksum and compression of a chunk, at any byte.
_CHUNK = re.compile(
    rb"(?=\x06.{3}[\x00-\x10]\x00{4}.{28}(?:\x00{4}|\x04\x00{3}zstd|\x03\x00{3}lz4))", re.DOTALL
)

# Exceptions of a damaged record: at its end, in its fields, in its compressed data.
DAMAGED: tuple[type[Exception], ...] = (
    *(McapError, struct.error, ValueError, EOFError, RuntimeError, zstandard.ZstdError),
    *(MemoryError, OverflowError),  # of an impossible length
)


class Piece(NamedTuple):
    """A record with its position in the file."""

    place: int
    opcode: int
    content: bytes

    @property
    def end(self) -> int:
        """Position after its last byte."""
        return self.place + _HEAD.size + len(self.content)

    @property
    def head(self) -> bytes:
        """Bytes before its content."""
        return _HEAD.pack(self.opcode, len(self.content))


def piece_at(stream: BinaryIO) -> Piece:
    """The record at the position of `stream`; an empty one with `NO_RECORD` if none is whole."""
    place, head = stream.tell(), stream.read(_HEAD.size)
    opcode, length = _HEAD.unpack(head) if len(head) == _HEAD.size else (NO_RECORD, 0)
    content = stream.read(length) if length <= LONGEST_RECORD else b""
    return Piece(place, opcode, content) if len(content) == length else Piece(place, NO_RECORD, b"")


def record_of(opcode: int, content: bytes) -> Any:
    """A record of mcap; raises one of `DAMAGED` unless its fields fill `content` exactly."""
    if opcode not in _KINDS:
        raise McapError(f"no record has the opcode {opcode}")
    fields, sized = ReadDataStream(BytesIO(content)), (len(content),) * (opcode == Opcode.MESSAGE)
    record = _KINDS[opcode].read(fields, *sized)
    if fields.count != len(content):
        raise McapError(f"{len(content) - fields.count} bytes after the last field")
    return record


def opened(piece: Piece, indexes: bool = False) -> list[Any]:
    """The records of a chunk, or the record itself.

    Args:
        piece: the record.
        indexes: whether an index of messages is read, which takes longer than the messages;
            without, it has no records.

    Raises:
        one of `DAMAGED`: the record is damaged.
    """
    if piece.opcode == NO_RECORD:
        raise EndOfFile
    if piece.opcode == Opcode.MESSAGE_INDEX and not indexes:
        return []
    record = record_of(piece.opcode, piece.content)
    if isinstance(record, Attachment):
        checksum = int.from_bytes(piece.content[-4:], "little")
        if checksum not in (0, zlib.crc32(piece.content[:-4])):
            raise McapError("checksum error")
    found = _unpacked(record) if isinstance(record, Chunk) else [record]
    return [_published(each) for each in found]


def next_chunk(stream: BinaryIO, begin: int) -> int | None:
    """Position of the first intact, non-empty chunk after `begin`; None if there is none."""
    with mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as data:
        for match in _CHUNK.finditer(data, begin):
            stream.seek(match.start())
            try:
                if opened(piece_at(stream)):
                    return match.start()
            except DAMAGED:
                continue
    return None


def _unpacked(chunk: Chunk) -> list[Any]:
    """The records of a chunk, in two thirds of the time of mcap's `breakup_chunk`."""
    _check_size(chunk)
    stream, size = get_chunk_data_stream(chunk, validate_crc=True)
    data, end, found = stream.read(size), 0, list[Any]()
    while end < size:
        opcode, length = _HEAD.unpack_from(data, end)
        begin = end + _HEAD.size
        end = begin + length
        if opcode == Opcode.MESSAGE:
            channel, sequence, log_time, publish_time = _MESSAGE.unpack_from(data, begin)
            content = data[begin + _MESSAGE.size : end]
            found.append(Message(channel, log_time, content, publish_time, sequence))
        else:
            found.append(record_of(opcode, data[begin:end]))
    return found


def _check_size(chunk: Chunk) -> None:
    """Raise an error before memory is taken for a chunk of another size than its header states."""
    size = stated = chunk.uncompressed_size
    if chunk.compression == "zstd":
        size = zstandard.frame_content_size(chunk.data)
    elif chunk.compression == "lz4":
        size = lz4.frame.get_frame_info(chunk.data)["content_size"] or stated
    elif chunk.compression:
        raise UnsupportedCompressionError(chunk.compression)
    if stated > LONGEST_RECORD or size not in (-1, stated):
        raise RecordLengthLimitExceeded(Opcode.CHUNK, max(size, stated), LONGEST_RECORD)


def _published(record: Any) -> Any:
    """A message as it was published; rosbag2 compresses each by itself in compression mode message.

    What is no such message stays as it is: its topic's reader refuses it.
    """
    if not isinstance(record, Message) or record.data[:4] != _ZSTD:
        return record
    try:
        plain = zstandard.ZstdDecompressor().decompress(record.data, max_output_size=LONGEST_RECORD)
    except zstandard.ZstdError:
        return record
    return replace(record, data=plain)
