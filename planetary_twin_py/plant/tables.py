"""Writes the measurements of a plant as tables."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from ..following.channels.all import CHANNELS
from ..following.channels.sampled import SAMPLE
from ..recording.tables.message_tables import Batch
from ..recording.tables.table_files import write_batches
from .device import simulated
from .readings import Plant, simulate_readings
from .sampled import Samples, simulate_samples


class PlantTable(NamedTuple):
    """A table of measurements, computed while it is written."""

    units: dict[str, str]
    """Unit by column."""
    batches: Iterator[Batch]


def readings_table(plant: Plant) -> PlantTable:
    """Readings of torque, speed and temperature."""
    time, readings = simulate_readings(plant)
    return PlantTable({"time": "s", **CHANNELS}, iter([{"time": time, **readings}]))


def samples_table(plant: Plant, name: str) -> PlantTable:
    """Samples of a device of `DEVICES`: counts with their numbers, others with their times."""
    units, rate = simulated(name).units, plant.hidden.device(name).rate
    numbered = not any(units.values())

    def batch(samples: Samples) -> Batch:
        place = {SAMPLE: samples.sample} if numbered else {"time": samples.sample / rate}
        return place | dict(zip(units, samples.values.T, strict=True))

    first = {SAMPLE: ""} if numbered else {"time": "s"}
    return PlantTable(first | units, map(batch, simulate_samples(plant, name)))


def write_table(table: PlantTable, path: Path) -> int:
    """Write a .csv, .parquet or .npz table; return the number of its rows."""
    return write_batches(path, table.units, table.batches)
