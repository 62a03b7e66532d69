"""Numbers and dates in the cells of a column."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from ...text.escaping import one_line
from ...units.conversion import LARGEST, column_to_si
from .time_steps import DATE

Array = NDArray[np.float64]
_LONGEST_VALUE = 60  # characters


def in_si(
    name: str,
    column: pa.ChunkedArray,
    given: str | None,
    unit: str,
    largest: float = LARGEST,
    *,
    dates: bool = False,
) -> Array:
    """Values of a column.

    Args:
        name: name of the column, for messages.
        column: numbers, or dates.
        given: unit of the column; None means SI.
        unit: SI unit of the result.
        largest: largest magnitude of a value; infinite for readings that are judged later.
        dates: whether it may have dates, which become seconds since the earliest one.

    Returns:
        Values (rows,) in `unit`, NaN where the column is empty.

    Raises:
        ValueError: a value is not a number or exceeds `largest`, or `given` does not match `unit`.
    """
    if dates and pa.types.is_timestamp(column.type):
        return _seconds(column)
    values = _numbers(name, column, dates)
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
    given = stamps(dates)
    return np.asarray((given - earliest(given)) / np.timedelta64(1, "s"), dtype=float)


def earliest(given: NDArray[np.datetime64]) -> np.datetime64:
    """The earliest date that is not missing; NaT if all are."""
    known = given[~np.isnat(given)]
    return known.min() if len(known) else np.datetime64("NaT")


def stamps(dates: pa.ChunkedArray) -> NDArray[np.datetime64]:
    """The dates of a column, (rows,)."""
    return np.asarray(dates.to_numpy().astype("datetime64[ns]"))


def _numbers(name: str, column: pa.ChunkedArray, dates: bool) -> Array:
    """Values (rows,) of a column, NaN where it is empty."""
    if pa.types.is_boolean(column.type):
        raise ValueError(f"{name}: must be numbers, not true or false")
    try:
        return np.asarray(column.cast(pa.float64()).to_numpy(), dtype=float)
    except (pa.ArrowInvalid, pa.ArrowNotImplementedError):  # value by value, to name the row
        return np.array([_number(name, k, cell.as_py(), dates) for k, cell in enumerate(column, 1)])


def _number(name: str, row: int, value: Any, dates: bool) -> float:
    try:
        return math.nan if value is None else float(value)
    except (TypeError, ValueError):
        shown = one_line(str(value), _LONGEST_VALUE)
        expected = f" of seconds, or a date such as {DATE}" if dates else ""
        raise ValueError(f"row {row}: {name} = {shown!r}: must be a number{expected}") from None
