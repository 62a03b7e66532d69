"""Writes the state of a fleet as a table."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..following.balance import UNITS
from ..recording.tables.table_files import write_batches
from .groups import GearboxResult


def write_state(path: Path, found: Sequence[GearboxResult]) -> None:
    """Write one row for each gearbox.

    Args:
        path: path of the table: .csv, .parquet or .npz.
        found: results, in the order of the rows.

    Raises:
        ValueError: the format is unknown.
        OSError: the file cannot be written.
    """
    units = {"first_missing": "s", "last_event": "s", "last_size": "N m", "scatter": "N m"}
    columns: dict[str, list[object]] = {}
    for result in found:
        last = result.events[-1] if result.events else None
        row: dict[str, object] = {
            "gearbox": result.gearbox,
            "readings": result.readings,
            "missing": result.missing[0],
            "first_missing": result.missing[1],
        }
        for name, estimate in result.estimates.items():
            for heading, value in zip((name, f"{name}_low", f"{name}_high"), estimate, strict=True):
                row[heading], units[heading] = value, UNITS[name]
        row |= {
            "fits": int(result.fits),
            "fault": result.fault,
            "events": len(result.events),
            "last_event": np.nan if last is None else last.found,
            "last_size": np.nan if last is None else last.size,
            "scatter": result.scatter[0],
            "smallest_step": result.smallest_step,
        }
        for heading, entry in row.items():
            columns.setdefault(heading, []).append(entry)
    batch = {heading: np.array(values) for heading, values in columns.items()}
    write_batches(path, {heading: units.get(heading, "") for heading in batch}, [batch])
