"""Writes the measurements of a plant as tables."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ..following.bins import CHANNELS
from ..following.measured_tables import COUNTS, SAMPLE
from ..recording.tables.message_tables import Column
from ..recording.tables.table_files import FORMATS
from .encoders import play_encoders
from .readings import Plant, play_readings
from .vibration import NAME, play_vibration


def write_readings(plant: Plant, path: Path) -> int:
    """Write readings of torque, speed and temperature.

    Args:
        plant: the plant.
        path: path of the table: .csv, .parquet or .npz.

    Returns:
        Number of rows.

    Raises:
        ValueError: the format is unknown, or the scene cannot be simulated.
        OSError: the file cannot be written.
    """
    time, columns = play_readings(plant)
    batch = {"time": time, **columns}
    units = {"time": "s", **CHANNELS}
    table = _table(path, [Column(name, units[name], np.dtype(float)) for name in batch])
    table.write(batch)
    table.close()
    return len(time)


def write_encoders(plant: Plant, path: Path) -> int:
    """Write samples of both encoders.

    Args:
        plant: the plant.
        path: path of the table: .csv, .parquet or .npz.

    Returns:
        Number of rows.

    Raises:
        ValueError: the format is unknown, or the scene cannot be simulated.
        OSError: the file cannot be written.
    """
    names = SAMPLE, *COUNTS
    table = _table(path, [Column(name, "", np.dtype(np.int64)) for name in names])
    rows = 0
    for packet in play_encoders(plant):
        columns = (packet.sample, *packet.counts.T)
        table.write(dict(zip(names, columns, strict=True)))
        rows += len(packet.sample)
    table.close()
    return rows


def write_vibration(plant: Plant, path: Path) -> int:
    """Write samples of the accelerometer.

    Args:
        plant: the plant.
        path: path of the table: .csv, .parquet or .npz.

    Returns:
        Number of rows.

    Raises:
        ValueError: the format is unknown, or the scene cannot be simulated.
        OSError: the file cannot be written.
    """
    units = {"time": "s", NAME: "m/s^2"}
    table = _table(path, [Column(name, unit, np.dtype(float)) for name, unit in units.items()])
    rows = 0
    for packet in play_vibration(plant):
        time = packet.sample / plant.hidden.sensors.vibration.rate
        table.write({"time": time, NAME: packet.values})
        rows += len(packet.values)
    table.close()
    return rows


def _table(path: Path, columns: list[Column]) -> Any:
    kind = path.suffix.removeprefix(".")
    if kind not in FORMATS:
        raise ValueError(f"{path}: must end in {', '.join('.' + name for name in FORMATS)}")
    return FORMATS[kind](path, columns)
