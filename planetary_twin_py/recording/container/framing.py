"""The records of an MCAP file: their boundaries, contents and integrity.

A record of MCAP 0 is intact if its fields end where the record ends, and its checksum, if it has
one, is correct.
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
from mcap.data_stream import ReadDataStream
from mcap.exceptions import (
    EndOfFile,
    McapError,
    RecordLengthLimitExceeded,
    UnsupportedCompressionError,
)
from mcap.opcode import Opcode
from mcap.records import (
    Attachment,
    Channel,
    Chunk,
    DataEnd,
    Footer,
    Header,
    Message,
    Metadata,
    Schema,
)
from mcap.stream_reader import CRCValidationError

# The longest record of an intact recording is a chunk of a few MiB. A damaged length field may have
# any value, so the size of allocations must be limited.
_LONGEST_RECORD = 256 * 2**20
_HEAD = struct.Struct("<BQ")  # opcode and length of a record
_MESSAGE = struct.Struct("<HIQQ")  # channel, sequence, log time and publish time of a message
_INDEX = struct.Struct("<HI")  # channel and bytes of the entries of a message index
_ENTRY = 16  # bytes: log time and place of a message
_ZSTD = b"\x28\xb5\x2f\xfd"  # with which no plain CDR begins
_TIMES_AND_SIZE = struct.Struct("<QQQ")  # of a chunk
_CHECKSUM = struct.Struct("<I")
_CONTENTS: dict[int, Any] = {
    Opcode.SCHEMA: Schema,
    Opcode.CHANNEL: Channel,
    Opcode.ATTACHMENT: Attachment,
    Opcode.METADATA: Metadata,
}
_STRUCTURE: dict[int, Any] = {
    Opcode.HEADER: Header,
    Opcode.DATA_END: DataEnd,
    Opcode.FOOTER: Footer,
}
_OPCODES = frozenset(Opcode)
# Head, times, size, checksum and compression of a chunk, at any byte.
_CHUNK = re.compile(
    rb"(?=\x06.{3}[\x00-\x10]\x00{4}.{28}(?:\x00{4}|\x04\x00{3}zstd|\x03\x00{3}lz4))", re.DOTALL
)


# Exceptions of a damaged record: at its end, in its fields, in its compressed data.
DAMAGED: tuple[type[Exception], ...] = (
    *(McapError, struct.error, ValueError, EOFError, zstandard.ZstdError),
    *(MemoryError, OverflowError),  # of an impossible length
)


class Piece(NamedTuple):
    """A record with its position in the file."""

    place: int
    opcode: int
    content: bytes
    head: bytes

    @property
    def end(self) -> int:
        """Position after its last byte."""
        return self.place + _HEAD.size + len(self.content)


class _Fields(ReadDataStream):
    """The fields of a record; raises `EndOfFile` for a truncated field."""

    def __init__(self, content: bytes) -> None:
        super().__init__(BytesIO(content))

    def read(self, length: int) -> bytes:
        data = super().read(length)
        if len(data) < length:
            raise EndOfFile
        return data


def piece_at(stream: BinaryIO) -> Piece:
    """The record at the position of `stream`; raises one of `DAMAGED` if there is none."""
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
    return Piece(place, opcode, content, head)


def opened(piece: Piece) -> list[Any]:
    """Contents of a record: the records of a chunk, the record itself, or none for an index.

    Raises:
        one of `DAMAGED`: the record is damaged.
    """
    opcode, content = piece.opcode, piece.content
    if opcode == Opcode.CHUNK:
        return _unpacked(_exact(Chunk, _Fields(content), content))
    if opcode == Opcode.MESSAGE:
        return [_published(_message(content, 0, len(content)))]
    if opcode == Opcode.MESSAGE_INDEX:
        indexed_messages(piece)
    elif opcode in _STRUCTURE:
        _exact(_STRUCTURE[opcode], _Fields(content), content)
    elif opcode in _CONTENTS:
        return [_exact(_CONTENTS[opcode], _Fields(content), content)]
    elif opcode not in _OPCODES:
        raise McapError(f"no record has the opcode {opcode}")
    return []


def indexed_messages(piece: Piece) -> int:
    """Number of messages that a message index lists."""
    _, size = _INDEX.unpack_from(piece.content)
    if len(piece.content) != _INDEX.size + size or size % _ENTRY:
        raise McapError("no message index")
    return int(size // _ENTRY)


def unpacked_size(piece: Piece) -> int:
    """Uncompressed size of a chunk according to its header, limited; 0 for other records."""
    if piece.opcode != Opcode.CHUNK or len(piece.content) < _TIMES_AND_SIZE.size:
        return 0
    *_, size = _TIMES_AND_SIZE.unpack_from(piece.content)
    return min(int(size), _LONGEST_RECORD)


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


def _exact(kind: Any, fields: ReadDataStream, content: bytes) -> Any:
    """A record whose `fields` fill `content` exactly."""
    record = kind.read(fields)
    if fields.count != len(content):
        raise McapError(f"{len(content) - fields.count} bytes after the last field")
    if isinstance(record, Attachment):
        (expected,) = _CHECKSUM.unpack(content[-_CHECKSUM.size :])
        checksum = zlib.crc32(content[: -_CHECKSUM.size])
        if expected not in (0, checksum):
            raise CRCValidationError(expected, checksum, record)
    return record


def _unpacked(chunk: Chunk) -> list[Any]:
    """The records of a chunk."""
    data = _decompressed(chunk)
    size = len(data)
    if chunk.uncompressed_crc not in (0, found := zlib.crc32(data)):
        raise CRCValidationError(chunk.uncompressed_crc, found, chunk)
    records: list[Any] = []
    end = 0
    while end < size:
        opcode, length = _HEAD.unpack_from(data, end)
        begin = end + _HEAD.size
        end = begin + length
        if end > size:
            raise EndOfFile
        if opcode == Opcode.MESSAGE:
            records.append(_published(_message(data, begin, end)))
        elif kind := _CONTENTS.get(opcode):
            records.append(_exact(kind, _Fields(part := data[begin:end]), part))
    return records


def _decompressed(chunk: Chunk) -> bytes:
    """The uncompressed data of a chunk, limited to the size in its header."""
    size = chunk.uncompressed_size
    if size > _LONGEST_RECORD:
        raise RecordLengthLimitExceeded(Opcode.CHUNK, size, _LONGEST_RECORD)
    data = chunk.data
    if chunk.compression == "zstd":
        if zstandard.frame_content_size(data) > size:
            raise McapError("a chunk is longer than its header states")
        data = zstandard.ZstdDecompressor().decompress(data, max_output_size=size)
    elif chunk.compression == "lz4":
        try:
            data = lz4.frame.LZ4FrameDecompressor().decompress(data, max_length=size)
        except RuntimeError as reason:
            raise McapError(str(reason)) from None
    elif chunk.compression:
        raise UnsupportedCompressionError(chunk.compression)
    if len(data) != size:
        raise EndOfFile
    return bytes(data)


def _message(data: bytes, begin: int, end: int) -> Message:
    if end - begin < _MESSAGE.size:
        raise EndOfFile
    channel, sequence, log_time, publish_time = _MESSAGE.unpack_from(data, begin)
    return Message(channel, log_time, data[begin + _MESSAGE.size : end], publish_time, sequence)


def _published(message: Message) -> Message:
    """A message as it was published; rosbag2 compresses each by itself in compression mode message.

    What is no such message stays as it is: its topic's reader refuses it.
    """
    data = message.data
    if data[:4] != _ZSTD:
        return message
    try:
        plain = zstandard.ZstdDecompressor().decompress(data, max_output_size=_LONGEST_RECORD)
    except zstandard.ZstdError:
        return message
    return replace(message, data=plain)
