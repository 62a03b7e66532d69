"""Writes an MCAP file of mcap's records, with memory that does not grow with its chunks.

mcap's `Writer` keeps the index of each chunk, 7 MB per hour with two chunks per second, and has no
way to store them elsewhere.
"""

from __future__ import annotations

import tempfile
import zlib
from collections import Counter
from pathlib import Path
from typing import Any, BinaryIO

import lz4.frame
import zstandard
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import (
    Attachment,
    AttachmentIndex,
    Channel,
    Chunk,
    ChunkIndex,
    DataEnd,
    Footer,
    Header,
    McapRecord,
    Message,
    MessageIndex,
    Metadata,
    MetadataIndex,
    Schema,
    Statistics,
    SummaryOffset,
)

from .extent import Extent
from .integrity import MAGIC
from .storage import Storage

_COMPRESS: dict[str, Any] = {
    "zstd": zstandard.compress,
    "lz4": lz4.frame.compress,
    "none": bytes,
}


class ChunkWriter:
    """Writes chunks of messages, and attachments and metadata between them.

    Every method raises `OSError` if the file is no longer writable.

    Args:
        stream: empty file to write.
        storage: compression and size of chunks.
        folder: where the indexes of chunks are stored until the end, in an unnamed file.
        library: name of the writing program.
    """

    def __init__(self, stream: BinaryIO, storage: Storage, folder: Path, library: str) -> None:
        self._stream, self._storage = stream, storage
        self.extent, self.counts = Extent(), Counter[int]()
        """Log times, and number of messages by channel."""
        self._checksum, self._chunks = 0, 0
        self._schemas: list[Schema] = []
        self._channels: list[Channel] = []
        self._attachments: list[AttachmentIndex] = []
        self._metadata: list[MetadataIndex] = []
        self._chunk_indexes = tempfile.TemporaryFile(dir=folder)  # noqa: SIM115 (closed at the end)
        self._chunk = RecordBuilder()
        self._entries: dict[int, MessageIndex] = {}  # of the messages in this chunk, by channel
        self._span = Extent()  # of their log times
        self._write(MAGIC)
        self._write(_bytes_of(Header("ros2", library)))

    def add_schema(self, name: str, encoding: str, data: bytes) -> int:
        """Add the schema of a type of messages; return its number."""
        schema = Schema(len(self._schemas) + 1, data, encoding, name)
        self._schemas.append(schema)
        schema.write(self._chunk)
        return schema.id

    def add_channel(self, topic: str, encoding: str, schema: int, metadata: dict[str, str]) -> int:
        """Add a channel; return its number."""
        channel = Channel(len(self._channels) + 1, topic, encoding, metadata, schema)
        self._channels.append(channel)
        channel.write(self._chunk)
        return channel.id

    def add_message(self, message: Message) -> None:
        """Add a message, and end the chunk if it is full."""
        channel = message.channel_id
        if channel not in self._entries:
            self._entries[channel] = MessageIndex(channel, [])
        self._entries[channel].records.append((message.log_time, self._chunk.count))
        self._span.include(message.log_time)
        self.extent.include(message.log_time)
        self.counts[channel] += 1
        message.write(self._chunk)
        if self._chunk.count > self._storage.chunk_bytes:
            self.end_chunk()

    def attach(self, attachment: Attachment) -> None:
        """Add an attachment."""
        data = _bytes_of(attachment)
        index = AttachmentIndex(
            offset=self._stream.tell(),
            length=len(data),
            log_time=attachment.log_time,
            create_time=attachment.create_time,
            data_size=len(attachment.data),
            name=attachment.name,
            media_type=attachment.media_type,
        )
        self._attachments.append(index)
        self._write(data)

    def note(self, metadata: Metadata) -> None:
        """Add a metadata record."""
        data = _bytes_of(metadata)
        self._metadata.append(MetadataIndex(self._stream.tell(), len(data), metadata.name))
        self._write(data)

    def end_chunk(self) -> None:
        """Write the messages added since the last chunk, if there are any."""
        if not self._entries:
            return
        data = _taken(self._chunk)
        compression = self._storage.compression
        packed = _COMPRESS[compression](data)
        chunk = Chunk(
            message_start_time=self._span.start,
            message_end_time=self._span.end,
            uncompressed_size=len(data),
            uncompressed_crc=zlib.crc32(data),
            compression=compression.replace("none", ""),
            data=packed,
        )
        place, record = self._stream.tell(), _bytes_of(chunk)
        self._write(record)
        offsets, indexes = {}, b""
        for channel, entries in self._entries.items():
            offsets[channel] = place + len(record) + len(indexes)
            indexes += _bytes_of(entries)
        self._write(indexes)
        index = ChunkIndex(
            message_start_time=chunk.message_start_time,
            message_end_time=chunk.message_end_time,
            chunk_start_offset=place,
            chunk_length=len(record),
            message_index_offsets=offsets,
            message_index_length=len(indexes),
            compression=chunk.compression,
            compressed_size=len(packed),
            uncompressed_size=len(data),
        )
        self._chunk_indexes.write(_bytes_of(index))
        self._chunks += 1
        self._entries, self._span = {}, Extent()

    def finish(self) -> None:
        """Write the last chunk, and the summary."""
        self.end_chunk()
        self._write(_bytes_of(DataEnd(self._checksum)))
        statistics = Statistics(
            message_count=self.counts.total(),
            schema_count=len(self._schemas),
            channel_count=len(self._channels),
            attachment_count=len(self._attachments),
            metadata_count=len(self._metadata),
            chunk_count=self._chunks,
            message_start_time=self.extent.start,
            message_end_time=self.extent.end,
            channel_message_counts=self.counts,
        )
        self._chunk_indexes.seek(0)
        start, summary, offsets = self._stream.tell(), b"", []
        for opcode, group in {
            Opcode.SCHEMA: _bytes_of(*self._schemas),
            Opcode.CHANNEL: _bytes_of(*self._channels),
            Opcode.STATISTICS: _bytes_of(statistics),
            Opcode.CHUNK_INDEX: self._chunk_indexes.read(),
            Opcode.ATTACHMENT_INDEX: _bytes_of(*self._attachments),
            Opcode.METADATA_INDEX: _bytes_of(*self._metadata),
        }.items():
            offsets.append(SummaryOffset(opcode, start + len(summary), len(group)))
            summary += group
        footer = Footer(start, start + len(summary), 0)
        summary += _bytes_of(*offsets)
        footer.summary_crc = zlib.crc32(_bytes_of(footer)[:-4], zlib.crc32(summary))
        self._write(summary + _bytes_of(footer) + MAGIC)

    def close(self) -> None:
        """Delete the stored indexes of chunks."""
        self._chunk_indexes.close()

    def _write(self, data: bytes) -> None:
        self._checksum = zlib.crc32(data, self._checksum)
        self._stream.write(data)


def _bytes_of(*records: McapRecord) -> bytes:
    builder = RecordBuilder()
    for record in records:
        record.write(builder)
    return _taken(builder)


def _taken(builder: RecordBuilder) -> bytes:
    """The bytes of a builder, which is empty then."""
    return bytes(builder.end())  # type: ignore[no-untyped-call]
