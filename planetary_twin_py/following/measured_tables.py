"""Reads readings, encoder samples and vibration from tables: CSV, Parquet or MAT files."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..recording.tables.measurements import TIME, Column, day_numbers, missing_column, read_columns
from ..text.escaping import one_line
from ..units.conversion import LARGEST
from .bins import AHEAD
from .channels.all import CHANNELS
from .follower import EncoderSamples, Readings
from .stamps import stamp_remarks, unset_stamps
from .vibration import VibrationSamples

ARRIVAL = "arrival"
SPARSE = 10.0  # median steps from all other rows beyond which a stamp may be wrong
SAMPLE, COUNTS = "sample", ("input_counts", "output_counts")


class MeasuredTable(NamedTuple):
    """Contents of a table."""

    readings: Readings
    """Readings in the order of their stamps; rows with the same stamp stay in order."""
    ignored: tuple[str, ...]
    """Headings of columns that are not used."""
    remarks: tuple[str, ...]
    """A line for each column without which less can be estimated, and for a doubtful time."""
    begin: np.datetime64 | None
    """Date of second 0 of the stamps; None if the table has no dates."""


def read_readings(path: Path, names: Mapping[str, str]) -> MeasuredTable:
    """Read a table of torques and speeds; stamps need not be equally spaced or in order.

    Args:
        path: path of a .csv, .parquet or .mat file. Headings are names of channels, with units
            unless these are SI: `input_speed [rpm]`; `time` and, if known, `arrival` [s].
        names: headings of channels whose columns have other names.

    Returns:
        The readings.

    Raises:
        ValueError: the file is not such a table, a value or a unit is invalid, the time or every
            channel is missing, or a heading of `names` does not exist.
        OSError: the file cannot be read.
    """
    table = read_columns(path)
    channel_of = {heading: name for name, heading in _chosen_headings(path, names, table).items()}
    units = CHANNELS | {ARRIVAL: "s"}
    columns: dict[str, np.ndarray] = {}
    ignored, stamps, begin = [], None, None
    for default_name, column in table.items():
        name = channel_of.get(column.heading, default_name)
        if name == TIME[0]:
            stamps, begin = np.array(column.in_si(name, "s")), column.begin
        elif name in columns:
            raise ValueError(f"{path}: column {column.heading!r}: {name} is given twice")
        elif name in units:
            columns[name] = column.in_si(name, units[name], math.inf)
        else:
            ignored.append(column.heading)
    arrival = columns.pop(ARRIVAL, None)
    if stamps is None:
        raise missing_column(path, TIME[0], table)
    if not columns:
        raise ValueError(
            f"{path}: has none of the columns {', '.join(CHANNELS)}; state other names under "
            f"`columns` in the file of --sensors; has {one_line(', '.join(ignored), 400)}"
        )
    if not any((np.isfinite(stamps) & np.isfinite(values)).any() for values in columns.values()):
        raise ValueError(f"{path}: has no row with a time and a reading")
    try:
        unset = [] if begin is not None else list(_without_unset(stamps))
        unset += list(stamp_remarks(stamps[np.isfinite(stamps)]))
    except ValueError as reason:
        raise ValueError(f"{path}: {reason}") from None
    readings = _in_order(Readings(stamps, columns, arrival))
    remarks = [*_lacking(columns), *filter(None, [day_numbers(readings.time)]), *unset]
    return MeasuredTable(readings, tuple(ignored), tuple(remarks), begin)


def _without_unset(stamps: np.ndarray) -> Iterator[str]:
    """Remove stamps that were never set, in place; a line if there are any."""
    unset = np.flatnonzero(unset_stamps(stamps))
    stamps[unset] = np.nan
    if len(unset):
        yield (
            f"{len(unset)} rows have the stamp 0 between later ones, the first is row "
            f"{unset[0] + 1}: they are not used"
        )


def _lacking(columns: Mapping[str, np.ndarray]) -> Iterator[str]:
    """A line for each quantity without which losses are not estimated."""
    for needed in (("input_torque",), ("output_torque",), ("input_speed", "output_speed")):
        if not any(name in columns and np.isfinite(columns[name]).any() for name in needed):
            yield (
                f"no column {' or '.join(needed)} with readings: losses are not estimated; "
                "if it has another heading, state that under `columns` in the file of --sensors"
            )


def _in_order(read: Readings) -> Readings:
    """Readings in the order of their stamps; rows without a stamp are last.

    A table is complete, so no row is late in it. Wrong stamps stay where they are among the others,
    so that the follower recognises them.
    """
    if not np.any(np.diff(read.time[np.isfinite(read.time)]) < 0.0):
        return read
    key = read.time.copy()
    wrong = _wrong_stamps(key)
    earlier = np.fmax.accumulate(np.where(wrong, -np.inf, key))
    key[wrong] = earlier[wrong]
    order = np.argsort(key, kind="stable")
    columns = {name: values[order] for name, values in read.columns.items()}
    arrival = None if read.arrival is None else read.arrival[order]
    return read._replace(time=read.time[order], columns=columns, arrival=arrival)


def _wrong_stamps(time: np.ndarray) -> NDArray[np.bool_]:
    """Stamps ahead of both neighbours, and far from all that are not, (rows,).

    In a table in any order many stamps are ahead of both neighbours: those are right that a chain
    of close stamps connects with another.
    """
    known = np.flatnonzero(np.isfinite(time))
    stamps = time[known]
    beside = np.concatenate([[-np.inf], stamps, [-np.inf]])
    leap = stamps > np.maximum(beside[:-2], beside[2:]) + AHEAD
    order = np.argsort(stamps, kind="stable")
    steps = np.diff(stamps[order])
    far = max(AHEAD, SPARSE * float(np.median(steps)))
    group = np.concatenate([[0], np.cumsum(steps > far)])  # of stamps close to each other
    usual = np.bincount(group, ~leap[order]) > 0
    wrong = np.zeros(len(time), dtype=bool)
    wrong[known[order]] = usual.any() & ~usual[group]
    return wrong


def read_encoders(path: Path, period: float, begin: np.datetime64 | None = None) -> EncoderSamples:
    """Read a table of the counts of two encoders.

    Args:
        path: path of a .csv, .parquet or .mat file with the columns input_counts and output_counts,
            and either the number `sample` or the `time`, in seconds of the stamps of the readings
            or in dates.
        period: sample period [s].
        begin: date of second 0 of the stamps of the readings; None if they have no dates.

    Returns:
        The samples, in the order of the rows.

    Raises:
        ValueError: a column is missing or has values other than whole numbers, the times are
            not multiples of the period, or they are dates and those of the readings are not.
        OSError: the file cannot be read.
    """
    columns = read_columns(path)
    for name in COUNTS:
        if name not in columns:
            raise missing_column(path, name, columns)
    counts = np.stack(
        [_whole_numbers(path, name, columns[name].in_si(name, "")) for name in COUNTS], axis=1
    )
    if SAMPLE in columns:
        sample = _whole_numbers(path, SAMPLE, columns[SAMPLE].in_si(SAMPLE, ""))
    elif TIME[0] in columns:
        number = columns[TIME[0]].in_si(TIME[0], "s") / period
        if not np.all((np.abs(number - np.round(number)) < 0.2) & (np.abs(number) <= LARGEST)):
            raise ValueError(
                f"{path}: time: must be multiples of {period:g} s; is the sample rate right?"
            )
        shift = round(_time_shift(path, columns[TIME[0]], begin) / period)
        sample = np.round(number).astype(np.int64) + shift
    else:
        raise ValueError(f"{path}: column {SAMPLE!r} or {TIME[0]!r}: missing")
    if not len(sample):
        raise ValueError(f"{path}: has no rows")
    return EncoderSamples(sample, counts)


def read_vibration(
    path: Path, names: Mapping[str, str], begin: np.datetime64 | None = None
) -> VibrationSamples:
    """Read a table of accelerations or other vibration.

    Args:
        path: path of a .csv, .parquet or .mat file with `time`, in seconds of the stamps of the
            readings or in dates, and a column for each sensor, in any unit. It may be the table of
            the readings: their columns, and those of encoders, are no vibration.
        names: headings of the channels of readings that have other names.
        begin: date of second 0 of the stamps of the readings; None if they have no dates.

    Returns:
        The samples in the order of their stamps. The sample period is the median step of the time.

    Raises:
        ValueError: the file is not such a table, a column is missing, or times are dates and those
            of the readings are not.
        OSError: the file cannot be read.
    """
    columns = read_columns(path)
    if TIME[0] not in columns:
        raise missing_column(path, TIME[0], columns)
    excluded = {*TIME, ARRIVAL, SAMPLE, *COUNTS, *CHANNELS, *names.values()}
    sensors = {
        column.heading: column.as_given(column.heading)
        for name, column in columns.items()
        if not excluded & {name, column.heading}
    }
    if not sensors:
        raise ValueError(f"{path}: has no column of vibration besides the time and the readings")
    ordered = _in_order(Readings(columns[TIME[0]].in_si(TIME[0], "s"), sensors))
    time = ordered.time
    steps = np.diff(time[np.isfinite(time)])
    period = float(np.median(steps)) if len(steps) else 0.0
    if not 0.0 < period < 1.0:
        raise ValueError(f"{path}: time: its median step is {period:g} s: must be within 0 and 1 s")
    shift = _time_shift(path, columns[TIME[0]], begin)
    return VibrationSamples(
        time + shift, np.stack([*ordered.columns.values()], axis=1), tuple(sensors), period
    )


def _time_shift(path: Path, time: Column, begin: np.datetime64 | None) -> float:
    """Seconds from the second 0 of the readings to that of another table."""
    if time.begin is None:
        return 0.0
    if begin is None:
        raise ValueError(
            f"{path}: time: has dates, but the readings have seconds: use one of these in both"
        )
    return float((time.begin - begin) / np.timedelta64(1, "s"))


def _chosen_headings(
    path: Path, names: Mapping[str, str], columns: Mapping[str, Column]
) -> dict[str, str]:
    """Headings of the channels that have other names."""
    chosen = {}
    for name, wanted in names.items():
        if name not in (*CHANNELS, *TIME, ARRIVAL):
            raise ValueError(f"columns.{name}: must be one of {', '.join((*CHANNELS, ARRIVAL))}")
        headings = [
            column.heading
            for column_name, column in columns.items()
            if wanted in (column.heading, column_name)
        ]
        if len(headings) != 1:
            listed = one_line(", ".join(column.heading for column in columns.values()), 400)
            raise ValueError(f"{path}: column {wanted!r}: no such column; has {listed}")
        chosen[TIME[0] if name in TIME else name] = headings[0]
    return chosen


def _whole_numbers(path: Path, name: str, values: np.ndarray) -> np.ndarray:
    for row in np.flatnonzero(~(np.isfinite(values) & (values == np.round(values))))[:1]:
        raise ValueError(f"{path}: row {row + 1}: {name} = {values[row]:g}: must be a whole number")
    return values.astype(np.int64)
