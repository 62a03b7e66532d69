"""Writes the estimates of a follower over time as a table."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..recording.tables.table_files import write_batches
from .state import Following


def write_notes(path: Path, states: Sequence[Following]) -> None:
    """Write one row for each estimated state to a .csv, .parquet or .npz file."""
    rows = [state for state in states if np.isfinite(state.time)]
    batch = {"time": np.array([state.time for state in rows])}
    units = {"time": "s", "events": ""}
    for name, unit in ((estimate.name, estimate.unit) for estimate in states[-1].estimates):
        for part in ("value", "low", "high"):
            column = name if part == "value" else f"{name}_{part}"
            batch[column] = np.array([getattr(state[name], part) for state in rows])
            units[column] = unit
    batch["events"] = np.array([len(state.events) for state in rows])
    write_batches(path, units, [batch])
