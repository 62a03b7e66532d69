"""Tables of a data set as Parquet."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet

from .columns import Column

GROUP = 16e6  # bytes of samples in a row group: readers load it as a whole


def write_signals(columns: Sequence[Column], rows: Iterable[dict[str, Any]], path: Path) -> None:
    """Write rows without samples.

    Args:
        columns: of the table.
        rows: values by name.
        path: file to write.

    Raises:
        OSError: the file cannot be written.
    """
    schema = _schema(columns)
    pyarrow.parquet.write_table(_table(schema, list(rows)), path, compression="zstd")


def write_samples(
    columns: Sequence[Column], rows: Iterable[dict[str, Any]], longest: int, path: Path
) -> None:
    """Write rows with samples.

    Args:
        columns: of the table.
        rows: values by name; samples are arrays, (n,).
        longest: number of samples of the longest signal.
        path: file to write.

    Raises:
        OSError: the file cannot be written.
    """
    schema = _schema(columns)
    with pyarrow.parquet.ParquetWriter(path, schema, compression="zstd") as writer:
        for group in _groups(rows, max(int(GROUP / (4 * longest)), 1)):
            writer.write_table(_table(schema, group))


def _groups(rows: Iterable[dict[str, Any]], size: int) -> Iterator[list[dict[str, Any]]]:
    waiting = iter(rows)
    while group := list(islice(waiting, size)):
        yield group


def _schema(columns: Sequence[Column]) -> pa.Schema:
    return pa.schema(
        pa.field(each.name, each.kind, metadata={"unit": each.unit, "description": each.text})
        for each in columns
    )


def _table(schema: pa.Schema, rows: list[dict[str, Any]]) -> pa.Table:
    return pa.table(
        [pa.array([row[field.name] for row in rows], field.type) for field in schema],
        schema=schema,
    )
