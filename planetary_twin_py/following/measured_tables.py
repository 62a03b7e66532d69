"""Reads measured readings and encoder samples from tables: CSV or Parquet."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..recording.tables.measurements import TIME, in_si, read_table
from .bins import CHANNELS
from .follower import EncoderSamples, Readings

_HEADING = re.compile(r"(.*?)\s*(?:\[(.*)\])?", re.DOTALL)
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
    table = read_table(path)
    parts = {heading: _parts(heading) for heading in table.column_names}
    channel = {heading: names_of for names_of, heading in _headings(path, names, parts).items()}
    units = CHANNELS | {ARRIVAL: "s"}
    columns, ignored, stamps = {}, [], None
    for heading, (name, unit) in parts.items():
        name = channel.get(heading, name)
        if name in TIME:
            stamps = in_si(TIME[0], table.column(heading), unit, "s")
        elif name in units:
            columns[name] = in_si(name, table.column(heading), unit, units[name])
        else:
            ignored.append(heading)
    arrival = columns.pop(ARRIVAL, None)
    if stamps is None:
        raise ValueError(f"{path}: column {TIME[0]!r}: missing")
    if not columns:
        raise ValueError(
            f"{path}: has none of the columns {', '.join(CHANNELS)}; state other names under "
            "`columns` in the file of --sensors"
        )
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
    table = read_table(path)
    for name in COUNTS:
        if name not in table.column_names:
            raise ValueError(f"{path}: column {name!r}: missing")
    counts = np.stack([_whole(path, name, in_si(name, table.column(name), None, ""))
                       for name in COUNTS], axis=1)  # fmt: skip
    if SAMPLE in table.column_names:
        sample = _whole(path, SAMPLE, in_si(SAMPLE, table.column(SAMPLE), None, ""))
    elif TIME[0] in table.column_names:
        number = in_si(TIME[0], table.column(TIME[0]), None, "s") / period
        if not np.all(np.abs(number - np.round(number)) < 0.2):
            raise ValueError(
                f"{path}: time: must be multiples of {period:g} s; is the sample rate right?"
            )
        sample = np.round(number).astype(np.int64)
    else:
        raise ValueError(f"{path}: column {SAMPLE!r} or {TIME[0]!r}: missing")
    return EncoderSamples(sample, counts)


def _headings(
    path: Path, names: Mapping[str, str], parts: Mapping[str, tuple[str, str | None]]
) -> dict[str, str]:
    """Headings of the channels that have other names."""
    found = {}
    for name, wanted in names.items():
        if name not in (*CHANNELS, *TIME, ARRIVAL):
            raise ValueError(f"columns.{name}: must be one of {', '.join((*CHANNELS, ARRIVAL))}")
        headings = [heading for heading, (own, _) in parts.items() if wanted in (heading, own)]
        if len(headings) != 1:
            raise ValueError(f"{path}: column {wanted!r}: no such column; has {', '.join(parts)}")
        found[name] = headings[0]
    return found


def _parts(heading: str) -> tuple[str, str | None]:
    parts = _HEADING.fullmatch(heading.strip())
    assert parts is not None  # the pattern matches every text
    return parts[1], parts[2]


def _whole(path: Path, name: str, values: np.ndarray) -> np.ndarray:
    for row in np.flatnonzero(~(values == np.round(values)))[:1]:  # NaN, too
        raise ValueError(f"{path}: row {row + 1}: {name} = {values[row]:g}: must be a whole number")
    return values.astype(np.int64)
