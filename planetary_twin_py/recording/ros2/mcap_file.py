"""Writes one MCAP file for rosbag2."""

from __future__ import annotations

import contextlib
import errno
import os
import time
from collections.abc import Mapping
from pathlib import Path

from mcap.records import Attachment, Message, Metadata

from ..container.extent import Extent
from ..container.storage import Storage
from ..container.writer import ChunkWriter
from .metadata import Topic

_LIBRARY = "planetary_twin"


class McapFile:
    """An MCAP file that is being written.

    Data written before the last `flush` survive a kill and a power failure. Every method raises
    `OSError` if the file is no longer writable.
    """

    def __init__(self, path: Path, storage: Storage) -> None:
        self.path = path
        self._unflushed = Extent()
        self._storage = storage
        self._stream = path.open("xb")
        self._writer = ChunkWriter(self._stream, storage, path.parent, _LIBRARY)
        self.extent, self.counts = self._writer.extent, self._writer.counts
        """Log times, and number of messages by channel."""

    @property
    def closed(self) -> bool:
        """Whether the file is finished or abandoned."""
        return self._stream.closed

    @property
    def size(self) -> int:
        """Size of the file [bytes], without the current chunk."""
        return self._stream.tell()

    def full(self, log_time: int) -> bool:
        """Whether a message received at `log_time` [ns] belongs in the next file."""
        start = self.extent.start
        return bool(start) and (
            log_time - start >= self._storage.longest or self.size >= self._storage.largest
        )

    def attach(self, name: str, data: bytes, media_type: str, at: int | None = None) -> None:
        """Add an attachment with a time [ns]; None: now."""
        time_of = time.time_ns() if at is None else at
        self._writer.attach(Attachment(time_of, time_of, name, media_type, data))

    def note(self, name: str, values: Mapping[str, str]) -> None:
        """Add a metadata record."""
        self._writer.note(Metadata(name, dict(values)))

    def add_topic(self, topic: Topic) -> int:
        """Open a channel; return its number, which counts from 1."""
        schema = self._writer.add_schema(topic.type, "ros2msg", topic.definition.encode())
        metadata = {"offered_qos_profiles": topic.qos_yaml, "topic_type_hash": topic.type_hash}
        return self._writer.add_channel(topic.name, "cdr", schema, metadata)

    def write(
        self, channel: int, data: bytes, log_time: int, publish_time: int, sequence: int
    ) -> None:
        """Append a message, and flush if those since the last flush cover the flush period.

        A kill then loses messages of at most one flush period of log time, even if a timer is late.
        """
        # MCAP stores 32 bits of the sequence number.
        message = Message(channel, log_time, data, publish_time, sequence & 0xFFFFFFFF)
        self._writer.add_message(message)
        self._unflushed.include(log_time)
        if self._unflushed.end - self._unflushed.start >= self._storage.unflushed:
            self.flush()

    def flush(self) -> None:
        """Write all buffered data to the disk (fsync)."""
        self._unflushed = Extent()
        self._writer.end_chunk()
        self._stream.flush()
        self._check_path()
        os.fsync(self._stream.fileno())

    def finish(self) -> None:
        """Write the indexes and close the file."""
        self._writer.finish()
        self._stream.flush()
        self._check_path()
        os.fsync(self._stream.fileno())
        self._stream.close()
        self._writer.close()

    def abandon(self) -> None:
        """Close a file that is no longer writable, e.g. on a full disk."""
        # Closing the buffered stream would write again; the descriptor must not leak.
        self._stream.raw.close()
        with contextlib.suppress(OSError):
            self._writer.close()

    def _check_path(self) -> None:
        """Raise `FileNotFoundError` if the file was deleted or moved, but is still writable."""
        try:
            same_file = os.path.samestat(os.stat(self.path), os.fstat(self._stream.fileno()))
        except FileNotFoundError:
            same_file = False
        if not same_file:
            raise FileNotFoundError(errno.ENOENT, "deleted or moved away", str(self.path))
