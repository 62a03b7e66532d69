"""Reads tables of a SCADA system: one row for each gearbox and time."""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from ..following.arrival.stamps import begin_of, stamp_remarks
from ..following.channels.all import CHANNELS as UNITS
from ..following.damage.rows import TORQUE_SD
from ..recording.tables.measurements import missing_column, read_columns
from ..recording.tables.time_steps import day_numbers
from .fleet import CHANNELS

Array = NDArray[np.float64]

GEARBOX, TIME = "gearbox", "time"


class FleetReadings(NamedTuple):
    """Readings of some gearboxes at all times of a table."""

    gearboxes: tuple[str, ...]
    time: Array
    """Times [s], in rising order, (m,)."""
    columns: dict[str, Array]
    """Readings by channel in SI, (m, n) each; NaN where there is no row."""
    remarks: tuple[tuple[str, ...], ...] = ()
    """Lines on the stamps of each gearbox, (n,)."""
    begin: float = 0.0
    """Second 0 of the times, from 1970 [s], of a table with dates: they count from its first."""


def gearboxes_of(path: Path) -> tuple[str, ...]:
    """Names of the gearboxes of a CSV or Parquet table, in order."""
    columns = read_columns(path)
    if GEARBOX not in columns:
        raise missing_column(path, GEARBOX, columns)
    names = pc.unique(columns[GEARBOX].values).to_pylist()
    if not names:
        raise ValueError(f"{path}: has no rows")
    return tuple(sorted(map(str, names)))


def read_fleet(path: Path, gearboxes: tuple[str, ...]) -> FleetReadings:
    """Read the rows of some gearboxes.

    Args:
        path: path of a CSV or Parquet file with the columns gearbox, time [s], input_torque,
            output_torque, input_speed and optionally oil_temperature and input_torque_std, the
            standard deviation of the torque within a row, with units in brackets unless they are
            SI. Signs are those of gearbox_state.
        gearboxes: names of the gearboxes to read.

    Returns:
        The readings.

    Raises:
        ValueError: a column is missing, or a unit or a value is invalid.
        OSError: the file cannot be read.
    """
    table = read_columns(path)
    for name in (GEARBOX, TIME, *CHANNELS[:3]):
        if name not in table:
            raise missing_column(path, name, table)
    labels = pc.cast(table[GEARBOX].values, pa.string())
    selected = pc.is_in(labels, pa.array(gearboxes))
    table = {
        name: column._replace(values=column.values.filter(selected))
        for name, column in table.items()
    }
    gearbox_index = np.asarray(pc.index_in(labels.filter(selected), pa.array(gearboxes)))
    stamps = table[TIME].in_si(TIME, "s")
    if not np.isfinite(stamps).all():
        raise ValueError(f"{path}: {TIME}: must be a finite number in every row")
    time, row = np.unique(stamps, return_inverse=True)
    if advice := day_numbers(time):
        raise ValueError(f"{path}: {advice}")
    file_rows = np.flatnonzero(selected) + 1
    remarks = []
    for n, name in enumerate(gearboxes):
        own = gearbox_index == n
        try:
            remarks.append([*stamp_remarks(stamps[own], file_rows[own])])
        except ValueError as fault:
            raise ValueError(f"{path}: {name}: {fault}") from None
    if reason := _different_stamps(time, row, gearbox_index):
        raise ValueError(f"{path}: {reason}")
    columns, repeated = {}, np.zeros(len(stamps), dtype=bool)
    place = row * len(gearboxes) + gearbox_index
    for name in (*CHANNELS, TORQUE_SD):
        values = np.full(len(time) * len(gearboxes), np.nan)
        if name in table:
            read = table[name].in_si(name, UNITS.get(name, "N m"), math.inf)
            known = np.flatnonzero(np.isfinite(read))
            _, first = np.unique(place[known], return_index=True)
            values[place[known[first]]] = read[known[first]]
            repeated[np.delete(known, first)] = True
        columns[name] = values.reshape(len(time), len(gearboxes))
    for n, lines in enumerate(remarks):
        again = file_rows[repeated & (gearbox_index == n)]
        if len(again):
            lines.append(f"{len(again)} rows repeat a time, the first is row {again[0]}: not used")
    begin = begin_of(table[TIME].begin)
    return FleetReadings(gearboxes, time, columns, tuple(map(tuple, remarks)), begin)


def _different_stamps(time: Array, row: NDArray[np.int64], gearbox: NDArray[np.int64]) -> str:
    """Reason to refuse gearboxes none of which has rows at most of the successive times."""
    own = [np.unique(row[gearbox == n]) for n in np.unique(gearbox)]
    own = [rows for rows in own if len(rows) > 1]
    if not own or min(np.median(np.diff(rows)) for rows in own) <= 1.0:
        return ""
    step = min(float(np.median(np.diff(time[rows]))) for rows in own)
    return (
        f"{TIME}: gearboxes have rows at different times: round the times of all to the same "
        f"multiples of {step:g} s"
    )
