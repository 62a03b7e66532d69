"""Reads tables of a SCADA system: one row for each gearbox and time."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from ..following.bins import CHANNELS as UNITS
from ..recording.tables.measurements import day_numbers, missing_column, read_columns
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


def gearboxes_of(path: Path) -> tuple[str, ...]:
    """Names of the gearboxes of a table, in order.

    Args:
        path: path of a CSV or Parquet file.

    Returns:
        The names.

    Raises:
        ValueError: the file is not such a table.
        OSError: the file cannot be read.
    """
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
            output_torque, input_speed and optionally oil_temperature, with units in brackets
            unless they are SI. Signs are those of gearbox_state.
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
    if reason := _different_stamps(time, row, gearbox_index):
        raise ValueError(f"{path}: {reason}")
    columns = {}
    for name in CHANNELS:
        values = np.full((len(time), len(gearboxes)), np.nan)
        if name in table:
            values[row, gearbox_index] = table[name].in_si(name, UNITS[name])
        columns[name] = values
    return FleetReadings(gearboxes, time, columns)


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
