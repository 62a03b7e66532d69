"""Chunk indexes of an MCAP file that is being written."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mcap.data_stream import RecordBuilder
from mcap.records import ChunkIndex
from mcap.writer import Writer

_INDEXES = "_Writer__chunk_indices"  # mcap 1.x has no public name for them


class ChunkIndexes:
    """
    Replaces the list in which mcap's `Writer` collects chunk indexes until it writes the summary.

    They are stored in an unnamed file in `folder`, because the list grows by 7 MB per hour with
    two chunks per second.
    """

    def __init__(self, folder: Path) -> None:
        self._file = tempfile.TemporaryFile(dir=folder)  # noqa: SIM115 (closed with the recording)

    @classmethod
    def replace(cls, writer: Writer, folder: Path) -> ChunkIndexes:
        """Replace the list of `writer`."""
        if getattr(writer, _INDEXES) != []:
            raise TypeError("mcap.writer.Writer: no empty list of chunk indexes")
        indexes = cls(folder)
        setattr(writer, _INDEXES, indexes)
        return indexes

    def append(self, index: ChunkIndex) -> None:
        """Store one; raises `OSError` if the disk is full."""
        builder = RecordBuilder()
        index.write(builder)
        self._file.write(builder.end())  # type: ignore[no-untyped-call]

    def __iter__(self) -> Iterator[Any]:
        """Yield this object, whose `write` writes all indexes at once."""
        yield self

    def write(self, summary: RecordBuilder) -> None:
        """Append all indexes to the summary of a file."""
        self._file.seek(0)
        summary.write(self._file.read())

    def close(self) -> None:
        """Delete the file."""
        self._file.close()
