"""Writers of tables, in batches: Parquet, CSV and NumPy's .npz."""

from __future__ import annotations

import shutil
import tempfile
import zipfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import pyarrow as pa
from pyarrow import csv, parquet

from .message_tables import Batch, Column
from .units_file import write_units

_GROUP = 2**15  # rows of a row group, at least: the writer keeps 1 kB of each column of every group


class TableFile(Protocol):
    """A table that is being written; all batches have the same columns."""

    def write(self, batch: Batch) -> None:
        """Append rows."""

    def close(self) -> None:
        """Finish the file."""


class Parquet:
    """Parquet, with units in the metadata of the columns."""

    def __init__(self, path: Path, columns: Sequence[Column]) -> None:
        self._schema = _schema(columns)
        self._writer = parquet.ParquetWriter(path, self._schema, compression="zstd")
        self._waiting: list[pa.Table] = []  # of the next row group
        self._rows = 0

    def write(self, batch: Batch) -> None:
        """Append rows."""
        self._waiting.append(_table(batch, self._schema))
        self._rows += len(self._waiting[-1])
        if self._rows >= _GROUP:
            self._write_group()

    def close(self) -> None:
        """Finish the file."""
        self._write_group()
        self._writer.close()

    def _write_group(self) -> None:
        if self._waiting:
            self._writer.write_table(pa.concat_tables(self._waiting))
        self._waiting, self._rows = [], 0


class Csv:
    """CSV with full precision, and units in a separate file NAME.units.json."""

    def __init__(self, path: Path, columns: Sequence[Column]) -> None:
        self._schema = _schema(columns)
        options = csv.WriteOptions(quoting_style="needed")
        self._writer = csv.CSVWriter(path, self._schema, write_options=options)
        units = {column.name: column.unit for column in columns}
        write_units(path, units)

    def write(self, batch: Batch) -> None:
        """Append rows."""
        self._writer.write_table(_table(batch, self._schema))

    def close(self) -> None:
        """Finish the file."""
        self._writer.close()


class Npz:
    """NumPy archive with an array per column; the arrays `columns` and `units` describe them.

    Arrays are in temporary files until their lengths are known.
    """

    def __init__(self, path: Path, columns: Sequence[Column]) -> None:
        self._path = path
        self._columns = columns
        self._rows = 0
        self._kinds = [column.kind for column in columns]
        self._open = ExitStack()
        enter = self._open.enter_context
        self._spools = [enter(tempfile.TemporaryFile()) for _ in columns]  # noqa: SIM115
        self._texts: dict[str, list[np.ndarray]] = {}

    def write(self, batch: Batch) -> None:
        """Append rows."""
        for column, spool in zip(self._columns, self._spools, strict=True):
            values = batch[column.name]
            if column.kind.kind == "U":  # the longest text differs between batches
                self._texts.setdefault(column.name, []).append(values)
            else:
                np.ascontiguousarray(values, column.kind).tofile(spool)
        self._rows += len(values)

    def close(self) -> None:
        """Finish the file."""
        with self._open, zipfile.ZipFile(self._path, "w") as archive:
            for column, spool in zip(self._columns, self._spools, strict=True):
                if texts := self._texts.get(column.name):
                    _store(archive, column.name, np.concatenate(texts))
                    continue
                spool.seek(0)
                with archive.open(f"{column.name}.npy", "w", force_zip64=True) as member:
                    header = {
                        "descr": np.lib.format.dtype_to_descr(column.kind),
                        "fortran_order": False,
                        "shape": (self._rows,),
                    }
                    np.lib.format.write_array_header_1_0(member, header)
                    shutil.copyfileobj(spool, member)
            _store(archive, "columns", np.array([column.name for column in self._columns]))
            _store(archive, "units", np.array([column.unit for column in self._columns]))


FORMATS: dict[str, Any] = {"parquet": Parquet, "csv": Csv, "npz": Npz}


class NewTable:
    """A table whose file is created with the first rows, because they have the columns.

    Args:
        path: of the file.
        kind: one of `FORMATS`.
        describe: gives the columns of rows.
    """

    def __init__(
        self, path: Path, kind: str, describe: Callable[[Batch], Sequence[Column]]
    ) -> None:
        self.path, self.rows = path, 0
        self._kind, self._describe = kind, describe
        self._file: TableFile | None = None

    def write(self, batch: Batch) -> None:
        """Append rows, if there are any."""
        if not batch:
            return
        if self._file is None:
            self._file = FORMATS[self._kind](self.path, self._describe(batch))
        self._file.write(batch)
        self.rows += len(next(iter(batch.values())))

    def close(self) -> None:
        """Finish the file, if there is one."""
        if self._file is not None:
            self._file.close()


def write_batches(path: Path, units: Mapping[str, str], batches: Iterable[Batch]) -> int:
    """Write a table whose format is the suffix of its path.

    Args:
        path: path of the table: .csv, .parquet or .npz.
        units: unit by column, in any order.
        batches: successive rows, all with the same columns.

    Returns:
        Number of rows.

    Raises:
        ValueError: the format is unknown.
        OSError: the file cannot be written.
    """
    kind = path.suffix.removeprefix(".")
    if kind not in FORMATS:
        raise ValueError(f"{path}: must end in {', '.join('.' + name for name in FORMATS)}")
    file, rows = None, 0
    for batch in batches:
        if file is None:
            columns = [Column(name, units[name], values.dtype) for name, values in batch.items()]
            file = FORMATS[kind](path, columns)
        file.write(batch)
        rows += len(next(iter(batch.values())))
    if file is None:
        file = FORMATS[kind](path, [Column(*one, np.dtype(float)) for one in units.items()])
    file.close()
    return rows


def _schema(columns: Sequence[Column]) -> pa.Schema:
    return pa.schema(
        [
            pa.field(
                column.name,
                pa.string() if column.kind.kind == "U" else pa.from_numpy_dtype(column.kind),
                metadata={"unit": column.unit},
            )
            for column in columns
        ]
    )


def _table(batch: Batch, schema: pa.Schema) -> pa.Table:
    # NaN is a published value, not a missing one.
    arrays = [pa.array(batch[field.name], field.type, from_pandas=False) for field in schema]
    return pa.Table.from_arrays(arrays, schema=schema)


def _store(archive: zipfile.ZipFile, name: str, values: np.ndarray) -> None:
    with archive.open(f"{name}.npy", "w") as member:
        np.lib.format.write_array(member, values, allow_pickle=False)
