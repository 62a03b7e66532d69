"""Reads a table of measurements: one row per interval, equally spaced, columns in SI."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from ...scene.names import did_you_mean
from ...text.escaping import one_line
from ...units.conversion import LARGEST
from .cells import earliest, in_si, stamps
from .readers import read_given
from .time_steps import day_numbers, time_step
from .units_file import units_beside

Array = NDArray[np.float64]

TIME = ("time", "simulated_time")  # end of the interval of a row: names in tables and recordings
LABEL = "operating_point"
UNREAD = ("stamp", "sequence", "interval", "planets")
"""Columns of an export that an import ignores, because it numbers its own messages."""
_LONGEST_LIST = 400  # characters
_NAMES = (
    "; a heading must be a field of gearbox_state or operating_point, with a unit in brackets "
    "unless it is SI"
)
_HEADING = re.compile(r"(.*?)\s*(?:\[(.*)\]|\(([^()]*)\))?", re.DOTALL)


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Context in which the message of every `ValueError` starts with the path of a table.

    Args:
        path: of the table; a message that starts with it stays as it is.
    """
    try:
        yield
    except ValueError as reason:
        named = str(reason).startswith(f"{path}: ")
        raise ValueError(str(reason) if named else f"{path}: {reason}") from None


def missing_column(path: Path, name: str, columns: Iterable[str]) -> ValueError:
    """The error that a column is missing, with the names that there are.

    Args:
        path: of the table.
        name: expected heading.
        columns: names in the headings of the table.
    """
    given = list(columns)
    near = next((one for one in given if re.sub(r"\W+", "_", one.lower()) == name), None)
    listed = one_line(", ".join(given), _LONGEST_LIST)
    advice = f"; has {listed}" if near is None else f"; rename {near} to {name}"
    return ValueError(f"{path}: column {name!r}: missing{advice}")


class Column(NamedTuple):
    """A column of a table."""

    heading: str
    unit: str | None
    """Unit in the heading or in the metadata of the column; None without."""
    values: pa.ChunkedArray
    """(rows,)."""
    path: Path
    """Of the table, for messages."""
    time: Array | None = None
    """Of each value [s], (rows,), if the file states times of this column alone, or their rate."""
    remarks: tuple[str, ...] = ()
    """What is doubtful about the file."""

    def in_si(self, name: str, unit: str, largest: float = LARGEST) -> Array:
        """Values in the SI unit `unit`, see `in_si`; `name` is for messages."""
        with naming(self.path):
            return in_si(name, self.values, self.unit, unit, largest, dates=name == TIME[0])

    def as_given(self, name: str) -> Array:
        """Values in the unit of the heading; `name` is for messages."""
        with naming(self.path):
            return in_si(name, self.values, None, "", dates=name == TIME[0])

    @property
    def begin(self) -> np.datetime64 | None:
        """The earliest date, from which `in_si` counts; None if the values are no dates."""
        dates = pa.types.is_timestamp(self.values.type) and len(self.values)
        return earliest(stamps(self.values)) if dates else None


class Measurements(NamedTuple):
    """Contents of a table."""

    step: float
    """Length of the interval of each row, which ends at its time stamp [s]."""
    columns: dict[str, Array]
    """Columns by name, each (rows,) in SI; NaN for missing values."""
    labels: Sequence[Any] | None
    """Values of the column `operating_point`; None if there is no such column."""

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(next(iter(self.columns.values())))


def read_measurements(path: Path, units: Mapping[str, str]) -> Measurements:
    """Read a table whose headings are names, or names with units: `speed [rpm]`.

    Args:
        path: path of the .csv, .parquet or .mat file.
        units: SI unit of every allowed column, by name.

    Returns:
        The measurements in SI.

    Raises:
        ValueError: a heading, a value or a time stamp is invalid.
        OSError: the file cannot be read.
    """
    table = read_columns(path)
    for name, column in table.items():
        if name not in (TIME[0], LABEL, *UNREAD, *units):
            near = did_you_mean(name, [TIME[0], LABEL, *units])
            raise ValueError(f"{path}: column {column.heading!r}: no such quantity{near or _NAMES}")
    if TIME[0] not in table:
        raise missing_column(path, TIME[0], table)
    labels = table.pop(LABEL).values.to_pylist() if LABEL in table else None
    columns = {
        name: column.in_si(name, units.get(name, "s"))
        for name, column in table.items()
        if name not in UNREAD
    }
    with naming(path):
        time = columns.pop(TIME[0])
        if advice := day_numbers(time):
            raise ValueError(advice)
        step = time_step(time)
    if not any(np.isfinite(values).any() for values in columns.values()):
        raise ValueError(f"{path}: has no value besides the time")
    return Measurements(step, columns, labels)


def read_columns(path: Path) -> dict[str, Column]:
    """Read a table whose headings are names, or names with units: `speed [rpm]`.

    Args:
        path: see `read_channels`.

    Returns:
        The columns by name, in order, all with as many rows.

    Raises:
        ValueError: see `read_channels`; or columns have several lengths.
        OSError: the file cannot be read.
    """
    columns = read_channels(path)
    if all(name.isdigit() for name in columns):
        raise ValueError(f"{path}: row 1: must have the headings of the columns, such as time [s]")
    first, length = next((name, len(one.values)) for name, one in columns.items())
    for name, column in columns.items():
        if len(column.values) != length:
            raise ValueError(
                f"{path}: {name}: must be a vector as long as {first}, {length} and not "
                f"{len(column.values)}"
            )
    return columns


def read_channels(path: Path) -> dict[str, Column]:
    """Read the columns of a table, or the channels of another file, which may have several lengths.

    A column of Parquet may have its unit in its metadata instead of its heading, as `unit`, and one
    of any table in the file NAME.units.json beside it, as `export` writes it.

    Args:
        path: path of a table (see `is_table`), NumPy archive or MCAP recording. For CSV see
            `read_csv`. The columns of a MAT file are its vectors.

    Raises:
        ValueError: the file is not such a table, or a name is given twice, perhaps in two units.
        OSError: the file cannot be read.
    """
    given = read_given(path)
    columns: dict[str, Column] = {}
    stated = units_beside(path)
    for each in given:
        name, unit = name_and_unit(each.heading)
        if name and name in columns:
            raise ValueError(f"{path}: column {each.heading!r}: {name} is given twice")
        unit = unit or each.unit or stated.get(each.heading)
        unit = None if unit in ("", "-") else unit
        values = each.values
        if isinstance(values, np.ndarray):
            values = pa.chunked_array([pa.array(np.ascontiguousarray(values))])
        columns[name] = Column(each.heading, unit, values, path, each.time, each.remarks)
    return columns


def name_and_unit(heading: str) -> tuple[str, str | None]:
    """Name and unit in a heading; the unit is None without brackets or parentheses.

    Args:
        heading: such as `speed [rpm]` or `speed (rpm)`. Every name of `TIME` is that of the time,
            also with capital letters.
    """
    parts = _HEADING.fullmatch(heading.strip())
    assert parts is not None  # the pattern matches every text
    name, in_brackets, in_parentheses = parts.groups()
    unit = in_parentheses if in_brackets is None else in_brackets
    return TIME[0] if name.lower() in TIME else name, unit
