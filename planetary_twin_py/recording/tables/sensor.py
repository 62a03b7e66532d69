"""Reads the samples of one sensor from a table, for example a vibration with its time stamps."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...units.conversion import column_to_si
from .chosen_column import chosen, listed, state_units
from .measurements import TIME, Array, Column, naming, read_channels
from .other_rate import other_rate
from .rounded_stamps import rounded_grid
from .scaling import Scaling, scaled
from .sensor_faults import fault_remarks
from .speed_faults import SpeedColumn, check_one_way, is_pulse_train, jump_remarks
from .time_steps import time_step
from .wav_file import OF_FULL_SCALE

SPEEDS = "speed", "input_speed", "output_speed"  # names of columns of a speed without a unit


class Sensor(NamedTuple):
    """Samples of a sensor."""

    name: str
    unit: str
    """Unit in the heading of the column; "-" if it has none."""
    time: Array
    """Time stamps [s], (n,), increasing by nearly equal steps."""
    samples: Array
    """Samples in `unit`, (n,)."""
    speed: Array | None
    """Measured speed of a shaft [rad/s], (n,); None without a column of it."""
    remarks: tuple[str, ...] = ()
    """Warnings about the samples."""
    speed_jumps: tuple[str, ...] = ()
    """Warnings about the measured speed."""
    unused_speed: SpeedColumn | None = None
    """Measured speed of a shaft that was not selected; None if there is none, or one was."""
    date: np.datetime64 | None = None
    """Of time 0 if the time stamps are dates."""


class Wanted(NamedTuple):
    """What to read of a table."""

    column: str | None = None
    """Name or number of the column, with a unit if the table states none, as of a MAT file; None if
    the table has one column besides time and speed."""
    time: str | None = None
    """Name or number of the column of times; None is `time`, or the rate that the file states."""
    sample_rate: float | None = None
    """[Hz], in place of times. A remark names both rates if they differ."""
    scaling: Scaling = Scaling()
    begin: float | None = None
    """Start of the interval to read [s]; None is the first row."""
    end: float | None = None
    """End of the interval [s]; None is the last row."""


def read_sensor(
    path: Path, wanted: Wanted, speed: str | None = None, one_way: bool = False
) -> Sensor:
    """Read a column of a table or a channel of another file (see `read_channels`).

    Args:
        path: path of the file.
        wanted: the column and the interval.
        speed: name of the column with the measured speed of a shaft in the same rows, such as
            `speed` or `speed [rpm]`; None if there is none.
        one_way: whether the shaft must turn in one direction in the interval.

    Returns:
        The samples of the interval. Without time stamps, the first row of the table is at 0.

    Raises:
        ValueError: the file is not a table or a column does not exist; or in the interval, samples
            are missing, the time stamps are not about equally spaced, or the shaft rests or
            reverses.
        OSError: the file cannot be read.
    """
    columns = read_channels(path)
    names = _chosen(path, columns, wanted, speed)
    signal, rows = columns[names.signal], len(columns[names.signal].values)
    stated = _stated_times(columns, names.signal, names.time, wanted)
    time = _times(path, columns, names.time, wanted.sample_rate, stated, rows)
    with naming(path):  # what lies outside of the interval may be wrong
        _check_rows(columns, names.signal, len(time), names.speed)
        part = _rows(time, wanted.begin, wanted.end)
        samples = _complete(names.signal, signal.as_given(names.signal), part)
        samples, unit = scaled(samples, signal.unit, wanted.scaling)
        stamps, rounding = _even(time[part], part.start)
        measured, jumps = None, list[str]()
        if names.speed is not None:
            turning = columns[names.speed]
            given = turning.as_given(names.speed)[part]
            measured = _complete(names.speed, rotation(names.speed, turning), part)
            shown = SpeedColumn(names.speed, turning.heading, given)
            jumps += jump_remarks(shown, time[part], part.start)
            if one_way:
                check_one_way(shown, time[part], part.start)
    remarks = [*signal.remarks, *(rounding if wanted.sample_rate is None else ())]
    remarks += _doubts(columns, names, wanted.sample_rate, stated, part)
    if unit == OF_FULL_SCALE:
        remarks.append(
            "the samples are shares of full scale; state it, for example --full-scale '50 g'"
        )
    remarks += fault_remarks(stamps, samples)
    unused = None if speed is not None else _unused_speed(columns, names.signal, part, rows)
    return Sensor(
        names.signal, unit or "-", stamps, samples, measured, tuple(remarks), tuple(jumps), unused,
        columns[names.time].begin if names.time in columns else None,
    )  # fmt: skip


class _Names(NamedTuple):
    """Columns that are read."""

    signal: str
    time: str
    """Perhaps missing."""
    speed: str | None


def _chosen(path: Path, columns: dict[str, Column], wanted: Wanted, speed: str | None) -> _Names:
    """The columns that options select, which get the units that these state."""
    every, time_name = list(columns), TIME[0]
    if wanted.time is not None:
        time_name = chosen(path, "--time-column", wanted.time, every)
    names = [name for name in columns if name != time_name]
    speed_name = None if speed is None else chosen(path, "--speed", speed, names, every)
    others = [other for other in names if other != speed_name or wanted.column is not None]
    name = chosen(path, "--column", wanted.column, others, every)
    state_units(path, columns, "--speed", speed_name, speed)
    state_units(path, columns, "--column", name, wanted.column)
    state_units(path, columns, "--time-column", time_name, wanted.time)
    return _Names(name, time_name, speed_name)


def _times(
    path: Path,
    columns: Mapping[str, Column],
    name: str,
    rate: float | None,
    stated: Callable[[], Array] | None,
    rows: int,
) -> Array:
    """Times of all rows [s]: by the sample rate [Hz], or as stated."""
    if rate is not None:
        if not rate > 0.0:
            raise ValueError(f"sample_rate = {rate:g} Hz: must be greater than 0")
        return np.arange(rows) / rate
    if stated is not None:
        return stated()
    others = [other for other in columns if other != name]
    raise ValueError(
        f"{path}: column {name!r}: missing; name the column of times by --time-column, or give "
        f"--sample-rate; columns: {listed(others)}"
    )


def _doubts(
    columns: Mapping[str, Column],
    names: _Names,
    rate: float | None,
    stated: Callable[[], Array] | None,
    part: slice,
) -> Iterator[str]:
    """Remarks on a sample rate that contradicts the times, and a speed without a unit."""
    if rate is not None and stated is not None:
        own = columns[names.signal].time is not None
        where = columns[names.signal if own else names.time]
        yield from other_rate(stated, where.heading, rate, part)
    if names.speed is not None and columns[names.speed].unit is None:
        yield unknown_unit(columns[names.speed].heading, names.speed)


def _stated_times(
    columns: Mapping[str, Column], name: str, time_name: str, wanted: Wanted
) -> Callable[[], Array] | None:
    """Gives the times of a column that the file states [s], (rows,); None if it states none."""
    own = columns[name].time
    if own is not None and wanted.time is None:
        return lambda: own
    if time_name not in columns:
        return None
    return lambda: columns[time_name].in_si(TIME[0], "s")


def _check_rows(columns: Mapping[str, Column], name: str, rows: int, speed: str | None) -> None:
    """Raise `ValueError` if columns that belong together have several lengths."""
    for each in filter(None, (name, speed)):
        if len(columns[each].values) != rows:
            raise ValueError(f"{each}: has {len(columns[each].values)} rows, and the time {rows}")


def unknown_unit(heading: str, name: str) -> str:
    """A remark that a speed without a unit is read in rad/s."""
    return (
        f"column {heading!r} has no unit and is read in rad/s; otherwise state it, for example "
        f"--speed '{name} [rpm]'"
    )


def rotation(name: str, column: Column) -> Array:
    """A measured speed [rad/s], (n,).

    Args:
        name: of the column, for messages.
        column: in a unit of speed, or rad/s.

    Raises:
        ValueError: it has another unit.
    """
    try:
        return column.in_si(name, "rad/s")
    except ValueError as reason:
        if not is_pulse_train(column.as_given(name)):
            raise
        raise ValueError(f"{reason}; is it a pulse train? Its values must be speeds") from None


def _unused_speed(
    columns: Mapping[str, Column], signal: str, part: slice, rows: int
) -> SpeedColumn | None:
    """The first column of a speed besides the signal, without gaps between its values."""
    for name, column in columns.items():
        if name == signal or len(column.values) != rows or not _is_speed(name, column):
            continue
        try:
            values = column.as_given(name)[part]
        except ValueError:
            continue  # no numbers
        known = np.flatnonzero(np.isfinite(values))
        if len(known) >= 2:
            filled = np.interp(np.arange(len(values)), known, values[known])
            return SpeedColumn(name, column.heading, filled)
    return None


def _is_speed(name: str, column: Column) -> bool:
    """Whether the unit of a column is one of a speed of rotation, or its name without a unit."""
    if column.unit is None:
        return name.lower() in SPEEDS
    try:
        column_to_si(np.zeros(1), column.unit, "rad/s")
    except ValueError:
        return False
    return True


def _even(time: Array, first: int) -> tuple[Array, tuple[str, ...]]:
    """Stamps at about equal steps, those of `rounded_grid` with a remark.

    Args:
        time: time stamps [s], (n,).
        first: number of rows before these, for messages.
    """
    try:
        step = time_step(time, first)
    except ValueError as reason:
        if len(time) < 2:
            raise
        raise ValueError(
            f"{reason}; select an interval without it by --from and --to, or give --sample-rate if "
            "no sample is missing and the stamps are wrong"
        ) from None
    grid = rounded_grid(time)
    if grid is None:
        return time, ()
    return grid.time, (
        f"the time stamps are rounded to {grid.digit:.0e} s: equal steps that fit them are used, "
        f"{1.0 / step:.7g} Hz",
    )


def _rows(time: Array, begin: float | None, end: float | None) -> slice:
    """Rows from the first to the last stamp of an interval."""
    known = time[np.isfinite(time)]
    if (begin is None and end is None) or not len(known):
        return slice(0, len(time))
    low = float(known.min()) if begin is None else begin
    high = float(known.max()) if end is None else end
    inside = np.flatnonzero((time >= low) & (time <= high))
    if len(inside) < 2:
        raise ValueError(
            f"from {low:g} to {high:g} s: {len(inside)} rows; the table runs from "
            f"{known.min():g} to {known.max():g} s"
        )
    return slice(
        0 if begin is None else int(inside[0]), len(time) if end is None else int(inside[-1]) + 1
    )


def _complete(name: str, values: Array, part: slice) -> Array:
    """The values of some rows, if none is missing."""
    for row in np.flatnonzero(~np.isfinite(values[part]))[:1]:
        raise ValueError(
            f"row {part.start + row + 1}: {name}: has no value; select an interval with all values "
            "by --from and --to"
        )
    return values[part]
