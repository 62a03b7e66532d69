"""Reads readings from tables: CSV, Parquet or MAT files."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...recording.tables.measurements import TIME, Column, missing_column, read_columns
from ...recording.tables.time_steps import day_numbers
from ...text.escaping import one_line
from ..arrival.stamps import begin_of, stamp_remarks, unset_stamps
from ..channels.all import CHANNELS
from ..channels.block_tables import order_of
from ..channels.vibration import ARRIVAL
from ..damage.rows import TORQUE_SD
from ..readings import Readings


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
    units = CHANNELS | {ARRIVAL: "s", TORQUE_SD: "N m"}
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
    arrival, torque_sd = (columns.pop(name, None) for name in (ARRIVAL, TORQUE_SD))
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
    read = Readings(stamps, columns, arrival, torque_sd=torque_sd, begin=begin_of(begin))
    readings = read.part(order_of(stamps))
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


def _chosen_headings(
    path: Path, names: Mapping[str, str], columns: Mapping[str, Column]
) -> dict[str, str]:
    """Headings of the channels that have other names."""
    chosen = {}
    for name, wanted in names.items():
        if name not in (*CHANNELS, *TIME, ARRIVAL, TORQUE_SD):
            known = ", ".join((*CHANNELS, ARRIVAL, TORQUE_SD))
            raise ValueError(f"columns.{name}: must be one of {known}")
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
