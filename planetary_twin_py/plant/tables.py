"""Writes the measurements of a plant as tables."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..following.channels.all import CHANNELS
from ..following.measured_tables import COUNTS, SAMPLE
from ..recording.tables.message_tables import Column
from ..recording.tables.table_files import FORMATS
from .encoders import simulate_encoders
from .readings import Plant, simulate_readings
from .vibration import NAME, simulate_vibration


class PlantTable(NamedTuple):
    """A table of measurements, computed while it is written."""

    columns: list[Column]
    batches: Iterator[dict[str, NDArray[Any]]]
    """Values by column, (n,) each."""


def readings_table(plant: Plant) -> PlantTable:
    """Readings of torque, speed and temperature.

    Args:
        plant: the plant.
    """
    time, readings = simulate_readings(plant)
    batch = {"time": time, **readings}
    units = {"time": "s", **CHANNELS}
    columns = [Column(name, units[name], np.dtype(float)) for name in batch]
    return PlantTable(columns, iter([batch]))


def encoders_table(plant: Plant) -> PlantTable:
    """Samples of both encoders.

    Args:
        plant: the plant; it has encoders.
    """
    names = SAMPLE, *COUNTS
    batches = (
        dict(zip(names, (sample, *counts.T), strict=True))
        for sample, counts in simulate_encoders(plant)
    )
    return PlantTable([Column(name, "", np.dtype(np.int64)) for name in names], batches)


def vibration_table(plant: Plant) -> PlantTable:
    """Samples of the accelerometer.

    Args:
        plant: the plant; it has an accelerometer.
    """
    rate, units = plant.hidden.sensors.vibration.rate, {"time": "s", NAME: "m/s^2"}
    batches = (
        {"time": packet.sample / rate, NAME: packet.values} for packet in simulate_vibration(plant)
    )
    columns = [Column(name, unit, np.dtype(float)) for name, unit in units.items()]
    return PlantTable(columns, batches)


def write_table(table: PlantTable, path: Path) -> int:
    """Write a table.

    Args:
        table: its columns and values.
        path: path of the file: .csv, .parquet or .npz.

    Returns:
        Number of rows.

    Raises:
        ValueError: the format is unknown, or the scene cannot be simulated.
        OSError: the file cannot be written.
    """
    kind = path.suffix.removeprefix(".")
    if kind not in FORMATS:
        raise ValueError(f"{path}: must end in {', '.join('.' + name for name in FORMATS)}")
    file, rows = FORMATS[kind](path, table.columns), 0
    for batch in table.batches:
        file.write(batch)
        rows += len(next(iter(batch.values())))
    file.close()
    return rows
