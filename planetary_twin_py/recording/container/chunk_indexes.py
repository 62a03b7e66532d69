"""Chunk indexes of an MCAP file in the making."""

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
    Takes the place of the list in which mcap's `Writer` keeps them until it writes the summary.

    They wait as bytes in an unnamed file in `folder`: the list grows by 7 MB an hour where two
    chunks are closed each second.
    """

    def __init__(self, folder: Path) -> None:
        self._file = tempfile.TemporaryFile(dir=folder)  # noqa: SIM115 (closed with the recording)

    @classmethod
    def replace(cls, writer: Writer, folder: Path) -> ChunkIndexes:
        """Have `writer` keep its chunk indexes so."""
        if getattr(writer, _INDEXES) != []:
            raise TypeError("mcap.writer.Writer: no empty list of chunk indexes")
        indexes = cls(folder)
        setattr(writer, _INDEXES, indexes)
        return indexes

    def append(self, index: ChunkIndex) -> None:
        """Keep one; raises `OSError` where the disk is full."""
        builder = RecordBuilder()
        index.write(builder)
        self._file.write(builder.end())  # type: ignore[no-untyped-call]

    def __iter__(self) -> Iterator[Any]:
        """Yield all of them as one, which is written as each of a list would be."""
        yield self

    def write(self, summary: RecordBuilder) -> None:
        """Append all of them to the summary of a file."""
        self._file.seek(0)
        summary.write(self._file.read())

    def close(self) -> None:
        """Let the file go."""
        self._file.close()
