"""Reads measured readings and encoder samples from tables: CSV or Parquet."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..printable import one_line
from ..recording.tables.measurements import TIME, Column, read_columns
from ..units import LARGEST
from .bins import CHANNELS
from .follower import EncoderSamples, Readings

ARRIVAL = "arrival"
SAMPLE, COUNTS = "sample", ("input_counts", "output_counts")


class MeasuredTable(NamedTuple):
    """Contents of a table."""

    readings: Readings
    """Readings in the order of the rows, which is the order of arrival."""
    ignored: tuple[str, ...]
    """Headings of columns that are not used."""


def read_readings(path: Path, names: Mapping[str, str]) -> MeasuredTable:
    """Read a table of torques and speeds; stamps need not be equally spaced.

    Args:
        path: path of a CSV or Parquet file. Headings are names of channels, with units unless these
            are SI: `input_speed [rpm]`; `time` and, if known, `arrival` [s].
        names: headings of channels whose columns have other names.

    Returns:
        The readings.

    Raises:
        ValueError: the file is not such a table, a value or a unit is invalid, the time or every
            channel is missing, or a heading of `names` does not exist.
        OSError: the file cannot be read.
    """
    found = read_columns(path)
    channel = {heading: name for name, heading in _headings(path, names, found).items()}
    units = CHANNELS | {ARRIVAL: "s"}
    columns: dict[str, np.ndarray] = {}
    ignored, stamps = [], None
    for own, column in found.items():
        name = channel.get(column.heading, own)
        if name == TIME[0]:
            stamps = column.in_si(name, "s")
        elif name in columns:
            raise ValueError(f"{path}: column {column.heading!r}: {name} is given twice")
        elif name in units:
            columns[name] = column.in_si(name, units[name])
        else:
            ignored.append(column.heading)
    arrival = columns.pop(ARRIVAL, None)
    if stamps is None:
        raise ValueError(f"{path}: column {TIME[0]!r}: missing")
    if not columns:
        raise ValueError(
            f"{path}: has none of the columns {', '.join(CHANNELS)}; state other names under "
            "`columns` in the file of --sensors"
        )
    if not any((np.isfinite(stamps) & np.isfinite(values)).any() for values in columns.values()):
        raise ValueError(f"{path}: has no row with a time and a reading")
    return MeasuredTable(Readings(stamps, columns, arrival), tuple(ignored))


def read_encoders(path: Path, period: float) -> EncoderSamples:
    """Read a table of the counts of two encoders.

    Args:
        path: path of a CSV or Parquet file with the columns input_counts and output_counts, and
            either the number `sample` or the `time` [s].
        period: sample period [s].

    Returns:
        The samples, in the order of the rows.

    Raises:
        ValueError: a column is missing or has values other than whole numbers, or the times are
            not multiples of the period.
        OSError: the file cannot be read.
    """
    found = read_columns(path)
    for name in COUNTS:
        if name not in found:
            raise ValueError(f"{path}: column {name!r}: missing")
    counts = np.stack([_whole(path, name, found[name].in_si(name, "")) for name in COUNTS], axis=1)
    if SAMPLE in found:
        sample = _whole(path, SAMPLE, found[SAMPLE].in_si(SAMPLE, ""))
    elif TIME[0] in found:
        number = found[TIME[0]].in_si(TIME[0], "s") / period
        if not np.all((np.abs(number - np.round(number)) < 0.2) & (np.abs(number) <= LARGEST)):
            raise ValueError(
                f"{path}: time: must be multiples of {period:g} s; is the sample rate right?"
            )
        sample = np.round(number).astype(np.int64)
    else:
        raise ValueError(f"{path}: column {SAMPLE!r} or {TIME[0]!r}: missing")
    if not len(sample):
        raise ValueError(f"{path}: has no rows")
    return EncoderSamples(sample, counts)


def _headings(path: Path, names: Mapping[str, str], found: Mapping[str, Column]) -> dict[str, str]:
    """Headings of the channels that have other names."""
    chosen = {}
    for name, wanted in names.items():
        if name not in (*CHANNELS, *TIME, ARRIVAL):
            raise ValueError(f"columns.{name}: must be one of {', '.join((*CHANNELS, ARRIVAL))}")
        headings = [c.heading for own, c in found.items() if wanted in (c.heading, own)]
        if len(headings) != 1:
            listed = one_line(", ".join(column.heading for column in found.values()), 400)
            raise ValueError(f"{path}: column {wanted!r}: no such column; has {listed}")
        chosen[TIME[0] if name in TIME else name] = headings[0]
    return chosen


def _whole(path: Path, name: str, values: np.ndarray) -> np.ndarray:
    for row in np.flatnonzero(~(np.isfinite(values) & (values == np.round(values))))[:1]:
        raise ValueError(f"{path}: row {row + 1}: {name} = {values[row]:g}: must be a whole number")
    return values.astype(np.int64)
