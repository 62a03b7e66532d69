"""A table measured on a rig: one row per interval, in evenly spaced steps, its columns in SI."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray
from pyarrow import csv, parquet

from ...printable import one_line
from ...scene.names import did_you_mean
from ...units import column_to_si

Array = NDArray[np.float64]

TIME = ("time", "simulated_time")  # of the end of a row's interval: a rig's word, and a recording's
LABEL = "operating_point"
UNREAD = ("stamp", "sequence", "interval", "planets")
"""Columns of an export that count messages; an import counts its own."""
_LONGEST_REASON = 200  # characters
UNEVEN = 0.1  # of a step, by which a time stamp may be off: loggers round them
_NAMES = (
    "; a column has the name of a field of gearbox_state or operating_point, with a unit in "
    "brackets where it is not SI"
)
_HEADING = re.compile(r"(.*?)\s*(?:\[(.*)\])?")


class Measurements(NamedTuple):
    """What a table holds."""

    step: float
    """Length of the interval of each row, at whose end its time stamp stands [s]."""
    columns: dict[str, Array]
    """By name, each (rows,) in SI; NaN where nothing was measured."""
    labels: Sequence[Any] | None
    """What the column `operating_point` says in each row; None without one."""

    @property
    def rows(self) -> int:
        """How many."""
        return len(next(iter(self.columns.values())))


def read_measurements(path: Path, units: Mapping[str, str]) -> Measurements:
    """Read a CSV or Parquet file whose headings are names, or names with units: `speed [rpm]`.

    Args:
        path: of the file.
        units: SI unit of every column there may be, by name.

    Raises:
        ValueError: a heading, a value or a time stamp cannot be.
        OSError: it cannot be read.
    """
    table = _read(path)
    found: dict[str, pa.ChunkedArray] = {}
    given: dict[str, str | None] = {}
    for heading, column in zip(table.column_names, table.columns, strict=True):
        name, unit = _named(heading, units)
        if name in found:
            raise ValueError(f"{path}: column {heading!r}: {name} is given twice")
        found[name], given[name] = column, unit
    if TIME[0] not in found:
        raise ValueError(f"{path}: column {TIME[0]!r}: missing")
    labels = found.pop(LABEL).to_pylist() if LABEL in found else None
    columns = {
        name: _in_si(name, column, given[name], units.get(name, "s"))
        for name, column in found.items()
        if name not in UNREAD
    }
    step = _step(columns.pop(TIME[0]))
    if not columns:
        raise ValueError(f"{path}: holds nothing that was measured beside the time")
    return Measurements(step, columns, labels)


def _read(path: Path) -> pa.Table:
    if path.suffix not in _READERS:
        raise ValueError(f"{path}: must end in {' or '.join(_READERS)}")
    if path.exists() and not path.is_file():
        raise ValueError(f"{path}: must be a file")
    try:
        with path.open("rb") as stream:
            return _READERS[path.suffix](stream)
    except UnicodeDecodeError as reason:
        raise ValueError(f"{path}: must be in UTF-8, byte {reason.start + 1} is not") from None
    except (pa.ArrowException, OSError) as reason:
        if isinstance(reason, OSError) and reason.errno is not None:  # of the system, not of Arrow
            raise
        raise ValueError(f"{path}: {one_line(str(reason), _LONGEST_REASON)}") from None


def _read_csv(stream: BinaryIO) -> pa.Table:
    """Separated by commas, semicolons or tabulators; decimal commas where none separates."""
    text = stream.read().decode()
    stream.seek(0)
    heading, _, body = text.partition("\n")
    separator = max(";\t,", key=heading.count)
    commas = separator != "," and re.search(r"\d,\d", body) and not re.search(r"\d\.\d", body)
    decimal = "," if commas else "."
    return csv.read_csv(
        stream,
        parse_options=csv.ParseOptions(delimiter=separator),
        convert_options=csv.ConvertOptions(decimal_point=decimal),
    )


_READERS: dict[str, Callable[[BinaryIO], pa.Table]] = {
    ".csv": _read_csv,
    ".parquet": parquet.read_table,
}


def _named(heading: str, units: Mapping[str, str]) -> tuple[str, str | None]:
    """Name and unit that a heading tells; no unit where it tells none."""
    parts = _HEADING.fullmatch(heading.strip())
    assert parts is not None  # whatever is no unit is a name
    name, unit = parts[1], parts[2]
    if name in TIME:
        return TIME[0], unit
    if name in units or name in (LABEL, *UNREAD):
        return name, unit
    near = did_you_mean(name, [TIME[0], LABEL, *units])
    raise ValueError(f"column {heading!r}: no such quantity{near or _NAMES}")


def _in_si(name: str, column: pa.ChunkedArray, given: str | None, unit: str) -> Array:
    """Values (rows,) of a column."""
    if name == TIME[0] and pa.types.is_timestamp(column.type):
        return _seconds(column)
    values = _numbers(name, column)
    if given is None:
        return values
    try:
        return column_to_si(values, given, unit)
    except ValueError as reason:
        raise ValueError(f"column {name!r}: {reason}") from None


def _seconds(dates: pa.ChunkedArray) -> Array:
    """Since the first of `dates` (rows,)."""
    stamps = dates.to_numpy().astype("datetime64[ns]")
    return np.asarray((stamps - stamps[:1]) / np.timedelta64(1, "s"), dtype=float)


def _numbers(name: str, column: pa.ChunkedArray) -> Array:
    """Values (rows,) of a column, NaN where it is empty."""
    try:
        return np.asarray(column.cast(pa.float64()).to_numpy(), dtype=float)
    except (pa.ArrowInvalid, pa.ArrowNotImplementedError):  # value by value, to tell of which
        return np.array([_number(name, k, value) for k, value in enumerate(column.to_pylist(), 1)])


def _number(name: str, row: int, value: Any) -> float:
    try:
        return math.nan if value is None else float(value)
    except (TypeError, ValueError):
        raise ValueError(f"row {row}: {name} = {str(value)!r}: must be a number") from None


def _step(time: Array) -> float:
    """The step of time stamps (rows,) [s] that follow one another evenly."""
    if len(time) < 2:
        raise ValueError(f"{len(time)} rows: must be at least 2, whose time stamps tell the step")
    steps = np.diff(time)
    for k in np.flatnonzero(~(steps > 0.0))[:1]:
        raise ValueError(
            f"row {k + 2}: time = {time[k + 1]:.9g} s: must be later than {time[k]:.9g} s, the row "
            "before"
        )
    usual = float(np.median(steps))
    for k in np.flatnonzero(np.abs(steps - usual) > UNEVEN * usual)[:1]:
        raise ValueError(
            f"row {k + 2}: time = {time[k + 1]:.9g} s: is {steps[k]:.6g} s after the row before, "
            f"must be {usual:.6g} s as most are, to within {UNEVEN:.0%}"
        )
    return float((time[-1] - time[0]) / len(steps))
