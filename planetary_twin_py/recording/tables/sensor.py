"""Reads the samples of one sensor from a table, for example a vibration with its time stamps."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...printable import one_line
from .measurements import TIME, Array, in_si, name_and_unit, read_columns, time_step


class Sensor(NamedTuple):
    """Uniformly spaced samples of a sensor."""

    name: str
    unit: str
    """As in the heading of the column; "-" if it has none."""
    time: Array
    """[s], (n,)."""
    samples: Array
    """[unit], (n,)."""


def read_sensor(path: Path, column: str | None, sample_rate: float | None) -> Sensor:
    """Read a column of a CSV, Parquet or MAT file whose headings are names, or names with units.

    Args:
        path: of the file.
        column: name of the column; None if the table has one column besides the time.
        sample_rate: [Hz], in place of a column `time`.

    Returns:
        The samples, which start at the first time stamp, or at 0 if `sample_rate` is given.

    Raises:
        ValueError: the file is not a table, the column does not exist, samples are missing, or the
            time stamps are not equally spaced.
        OSError: the file cannot be read.
    """
    found = read_columns(path)
    name = _chosen(path, column, [name for name in found if name != TIME[0]])
    chosen = found[name]
    samples = in_si(name, chosen.values, None, "")
    for row in np.flatnonzero(~np.isfinite(samples))[:1]:
        raise ValueError(f"{path}: row {row + 1}: {name}: has no value")
    if sample_rate is not None:
        if not sample_rate > 0.0:
            raise ValueError(f"sample_rate = {sample_rate:g} Hz: must be greater than 0")
        begin, step = 0.0, 1.0 / sample_rate
    elif TIME[0] in found:
        time = found[TIME[0]].in_si(TIME[0], "s")
        begin, step = float(time[0]) if len(time) else 0.0, time_step(time)
    else:
        raise ValueError(f"{path}: column {TIME[0]!r}: missing; add it or give --sample-rate")
    stamps = begin + step * np.arange(len(samples), dtype=float)
    return Sensor(name, chosen.unit or "-", stamps, samples)


def _chosen(path: Path, column: str | None, names: list[str]) -> str:
    own = name_and_unit(column)[0] if column is not None else None
    if own in names:
        return own
    if column is None and len(names) == 1:
        return names[0]
    listed = one_line(", ".join(names), 400) or "none besides the time"
    given = "choose one with --column" if column is None else f"column = {column!r}: no such column"
    raise ValueError(f"{path}: {given}; columns: {listed}")
