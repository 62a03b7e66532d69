"""Writes the state of a fleet as a table."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..following.balance import UNITS
from ..recording.tables.message_tables import Column
from ..recording.tables.table_files import FORMATS
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
    kind = path.suffix.removeprefix(".")
    if kind not in FORMATS:
        raise ValueError(f"must end in {', '.join('.' + name for name in FORMATS)}")
    batch: dict[str, np.ndarray] = {
        "gearbox": np.array([result.gearbox for result in found]),
        "readings": np.array([result.readings for result in found]),
        "missing": np.array([result.missing[0] for result in found]),
        "first_missing": np.array([result.missing[1] for result in found]),
    }
    units = {
        "gearbox": "",
        "readings": "",
        "missing": "",
        "first_missing": "s",
        "fits": "",
        "fault": "",
        "events": "",
        "last_event": "s",
        "last_size": "N m",
        "scatter": "N m",
        "smallest_step": "",
    }
    for name in found[0].estimates:
        for part, heading in enumerate((name, f"{name}_low", f"{name}_high")):
            batch[heading] = np.array([result.estimates[name][part] for result in found])
            units[heading] = UNITS[name]
    batch["fits"] = np.array([int(result.fits) for result in found])
    batch["fault"] = np.array([result.fault for result in found])
    batch["events"] = np.array([len(result.events) for result in found])
    last = [result.events[-1] if result.events else None for result in found]
    batch["last_event"] = np.array([np.nan if event is None else event.found for event in last])
    batch["last_size"] = np.array([np.nan if event is None else event.size for event in last])
    batch["scatter"] = np.array([result.scatter[0] for result in found])
    batch["smallest_step"] = np.array([result.smallest_step for result in found])
    columns = [Column(name, units[name], values.dtype) for name, values in batch.items()]
    table = FORMATS[kind](path, columns)
    table.write(batch)
    table.close()
