"""Reads a table of measurements: one row per interval, equally spaced, columns in SI."""

from __future__ import annotations

import math
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
from ...units.conversion import LARGEST, column_to_si
from .readers import read_given
from .rounded_stamps import UNEVEN, rounded_grid
from .units_file import units_beside

Array = NDArray[np.float64]

TIME = ("time", "simulated_time")  # end of the interval of a row: names in tables and recordings
LABEL = "operating_point"
UNREAD = ("stamp", "sequence", "interval", "planets")
"""Columns of an export that an import ignores, because it numbers its own messages."""
_LONGEST_REASON = 200  # characters
_LONGEST_VALUE = 60  # characters
_LONGEST_LIST = 400  # characters
DATE = "2026-11-22 10:00:00"  # example
_DAY_NUMBERS = 20_000.0, 80_000.0  # of a spreadsheet, from 1954 to 2119
_SHORT = 1e-3  # [s] step of readings, or a minute and a half in days
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


def day_numbers(time: Array) -> str:
    """Advice if times in seconds look like day numbers of a spreadsheet; empty otherwise.

    Args:
        time: times in their order [s], (rows,).
    """
    known = time[np.isfinite(time)]
    low, high = _DAY_NUMBERS
    if len(known) < 2 or known.min() < low or known.max() > high:
        return ""
    step = float(np.median(np.diff(known)))
    if not 0.0 < step < _SHORT:
        return ""
    return (
        f"time is {known[0]:.10g} s with steps of {step:.3g} s: are these day numbers of a "
        f"spreadsheet? Then write dates, such as {DATE}"
    )


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
            return in_si(name, self.values, self.unit, unit, largest)

    def as_given(self, name: str) -> Array:
        """Values in the unit of the heading; `name` is for messages."""
        with naming(self.path):
            return in_si(name, self.values, None, "")

    @property
    def begin(self) -> np.datetime64 | None:
        """The earliest date, from which `in_si` counts; None if the values are no dates."""
        dates = pa.types.is_timestamp(self.values.type) and len(self.values)
        return _earliest(_stamps(self.values)) if dates else None


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

    Returns:
        The columns by name, in order.

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


def in_si(
    name: str, column: pa.ChunkedArray, given: str | None, unit: str, largest: float = LARGEST
) -> Array:
    """Values of a column.

    Args:
        name: name of the column, for messages.
        column: numbers, or dates if it is the time.
        given: unit of the column; None means SI.
        unit: SI unit of the result.
        largest: largest magnitude of a value; infinite for readings that are judged later.

    Returns:
        Values (rows,) in `unit`, NaN where the column is empty.

    Raises:
        ValueError: a value is not a number or exceeds `largest`, or `given` does not match `unit`.
    """
    if name == TIME[0] and pa.types.is_timestamp(column.type):
        return _seconds(column)
    values = _numbers(name, column)
    if given is not None:
        try:
            values = column_to_si(values, given, unit)
        except ValueError as reason:
            raise ValueError(f"column {name!r}: {reason}") from None
    for row in np.flatnonzero(np.isfinite(values) & (np.abs(values) > largest))[:1]:
        raise ValueError(
            f"row {row + 1}: {name} = {values[row]:g}: its magnitude must be at most "
            f"{largest:.0e} {unit or '1'}; is the unit right?"
        )
    return values


def _seconds(dates: pa.ChunkedArray) -> Array:
    """Seconds since the earliest of `dates` (rows,)."""
    stamps = _stamps(dates)
    return np.asarray((stamps - _earliest(stamps)) / np.timedelta64(1, "s"), dtype=float)


def _earliest(stamps: NDArray[np.datetime64]) -> np.datetime64:
    """The earliest date that is not missing; NaT if all are."""
    known = stamps[~np.isnat(stamps)]
    return known.min() if len(known) else np.datetime64("NaT")


def _stamps(dates: pa.ChunkedArray) -> NDArray[np.datetime64]:
    return np.asarray(dates.to_numpy().astype("datetime64[ns]"))


def _numbers(name: str, column: pa.ChunkedArray) -> Array:
    """Values (rows,) of a column, NaN where it is empty."""
    if pa.types.is_boolean(column.type):
        raise ValueError(f"{name}: must be numbers, not true or false")
    try:
        return np.asarray(column.cast(pa.float64()).to_numpy(), dtype=float)
    except (pa.ArrowInvalid, pa.ArrowNotImplementedError):  # value by value, to name the row
        return np.array([_number(name, k, cell.as_py()) for k, cell in enumerate(column, 1)])


def _number(name: str, row: int, value: Any) -> float:
    try:
        return math.nan if value is None else float(value)
    except (TypeError, ValueError):
        shown = one_line(str(value), _LONGEST_VALUE)
        expected = f" of seconds, or a date such as {DATE}" if name == TIME[0] else ""
        raise ValueError(f"row {row}: {name} = {shown!r}: must be a number{expected}") from None


def time_step(time: Array, first: int = 0) -> float:
    """The step of equally spaced time stamps, which may be rounded (see `rounded_grid`).

    Args:
        time: time stamps [s], (rows,).
        first: number of rows before these, for messages.

    Returns:
        The step [s].

    Raises:
        ValueError: the stamps decrease or are not equally spaced.
    """
    if len(time) < 2:
        raise ValueError(f"{len(time)} rows: must be at least 2, to determine the time step")
    if (grid := rounded_grid(time)) is not None:
        time = grid.time
    steps = np.diff(time)
    for k in np.flatnonzero(~(steps > 0.0))[:1]:
        raise ValueError(
            f"row {first + k + 2}: time = {time[k + 1]:.9g} s: must be later than {time[k]:.9g} s "
            "in the previous row"
        )
    usual = float(np.median(steps))
    for k in np.flatnonzero(np.abs(steps - usual) > UNEVEN * usual)[:1]:
        raise ValueError(
            f"row {first + k + 2}: time = {time[k + 1]:.9g} s: is {steps[k]:.6g} s after the "
            f"previous row, must be {usual:.6g} s (the median step), to within {UNEVEN:.0%}"
        )
    return float((time[-1] - time[0]) / len(steps))
