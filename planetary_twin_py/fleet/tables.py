"""Reads tables of a SCADA system: one row for each gearbox and time."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from ..following.bins import CHANNELS as UNITS
from ..recording.tables.measurements import in_si, read_table
from .fleet import CHANNELS

Array = NDArray[np.float64]

GEARBOX, TIME = "gearbox", "time"
_HEADING = re.compile(r"(.*?)\s*(?:\[(.*)\])?", re.DOTALL)


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
    table = read_table(path)
    if GEARBOX not in table.column_names:
        raise ValueError(f"{path}: column {GEARBOX!r}: missing")
    return tuple(sorted(str(name) for name in pc.unique(table[GEARBOX]).to_pylist()))


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
    table = read_table(path)
    headings: dict[str, tuple[str, str | None]] = {}
    for heading in table.column_names:
        parts = _HEADING.fullmatch(heading.strip())
        assert parts is not None  # the pattern matches every text
        headings[parts[1]] = heading, parts[2]
    for name in (GEARBOX, TIME, *CHANNELS[:3]):
        if name not in headings:
            raise ValueError(f"{path}: column {name!r}: missing")
    labels = pc.cast(table[headings[GEARBOX][0]], pa.string())
    table = table.filter(pc.is_in(labels, pa.array(gearboxes)))
    labels = pc.cast(table[headings[GEARBOX][0]], pa.string())
    column = np.asarray(pc.index_in(labels, pa.array(gearboxes)))
    stamps = in_si(TIME, table[headings[TIME][0]], headings[TIME][1], "s")
    time, row = np.unique(stamps, return_inverse=True)
    columns = {}
    for name in CHANNELS:
        values = np.full((len(time), len(gearboxes)), np.nan)
        if name in headings:
            heading, unit = headings[name]
            values[row, column] = in_si(name, table[heading], unit, UNITS[name])
        columns[name] = values
    return FleetReadings(gearboxes, time, columns)
