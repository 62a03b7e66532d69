"""Accelerometers and other sensors of vibration, read by one device: messages and tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...recording.tables.measurements import TIME, missing_column, read_columns
from ..input_error import InputError
from .all import CHANNELS
from .block_tables import order_of, time_shift
from .sampled import DEVICES
from .stamp import stamp_of

ARRIVAL = "arrival"
"""Column with the times of arrival of readings [s]."""


class VibrationSamples(NamedTuple):
    """Samples of vibration in the order of their arrival."""

    time: NDArray[np.float64]
    """Stamps [s], (n,)."""
    values: NDArray[np.float64]
    """Samples in the units of the channels, (n, channels)."""
    names: tuple[str, ...]
    """Names of the channels."""
    period: float
    """Sample period [s]."""

    @property
    def device(self) -> str:
        """Name of the device."""
        return "vibration"

    def stamps(self) -> NDArray[np.float64]:
        """Stamps [s], (n,), without those that are missing."""
        return np.where(np.isfinite(self.time), self.time, -np.inf)

    def part(self, rows: slice) -> VibrationSamples:
        """Some of the samples."""
        return self._replace(time=self.time[rows], values=self.values[rows])


class VibrationMessages:
    """Converts blocks of samples, channel by channel."""

    def __init__(self) -> None:
        self._channels: tuple[tuple[str, ...], float] | None = None  # and sample period

    def unused(self, block: Any) -> str:
        """Why a block is not used: it has torques."""
        torques = "N m" in block.units
        return "samples of a torque, and torques are read from joint states" if torques else ""

    def read(self, sender: str, block: Any) -> VibrationSamples:
        """Convert a block of a topic.

        Raises `InputError` if it has other channels than the one before, or none.
        """
        names, period = tuple(block.names), float(block.sample_period)
        if not names or not 0.0 < period < 1.0:
            raise InputError(
                f"{sender}: {len(names)} names and a sample_period of {period:g} s: must be at "
                "least 1 and within 0 and 1 s"
            )
        expected = self._channels or (names, period)
        if (names, period) != expected:
            raise InputError(
                f"{sender}: names and sample_period are {', '.join(names)}, {period:g} s: must be "
                f"{', '.join(expected[0])}, {expected[1]:g} s as in the blocks before"
            )
        self._channels = expected
        samples = np.asarray(block.samples, dtype=np.float64)
        if len(samples) % len(names):
            raise InputError(
                f"{sender}: {len(samples)} samples: must be the same number of each of the "
                f"{len(names)} channels"
            )
        values = samples.reshape(len(names), -1).T
        time = stamp_of(block) + period * np.arange(len(values), dtype=np.float64)
        return VibrationSamples(time, values, names, period)

    def join(self, blocks: Sequence[VibrationSamples]) -> VibrationSamples:
        """Join successive samples."""
        return blocks[0]._replace(
            time=np.concatenate([block.time for block in blocks]),
            values=np.concatenate([block.values for block in blocks]),
        )


def read_vibration(
    path: Path, names: Mapping[str, str], begin: np.datetime64 | None = None
) -> VibrationSamples:
    """Read a table of accelerations or other vibration.

    Args:
        path: path of a .csv, .parquet or .mat file with `time`, in seconds of the stamps of the
            readings or in dates, and a column for each sensor, in any unit. It may be the table of
            the readings: their columns, and those of other devices, are no vibration.
        names: headings of the channels of readings that have other names.
        begin: date of second 0 of the stamps of the readings; None if they have no dates.

    Returns:
        The samples in the order of their stamps. The sample period is the median step of the time.

    Raises:
        ValueError: the file is not such a table, a column is missing, or times are dates and those
            of the readings are not.
        OSError: the file cannot be read.
    """
    columns = read_columns(path)
    if TIME[0] not in columns:
        raise missing_column(path, TIME[0], columns)
    excluded = {*TIME, ARRIVAL, *CHANNELS, *names.values()}
    excluded.update(name for device in DEVICES.values() for name in device.columns)
    sensors = {
        column.heading: column.as_given(column.heading)
        for name, column in columns.items()
        if not excluded & {name, column.heading}
    }
    if not sensors:
        raise ValueError(f"{path}: has no column of vibration besides the time and the readings")
    time = columns[TIME[0]].in_si(TIME[0], "s")
    order = order_of(time)
    time, values = time[order], np.stack([*sensors.values()], axis=1)[order]
    steps = np.diff(time[np.isfinite(time)])
    period = float(np.median(steps)) if len(steps) else 0.0
    if not 0.0 < period < 1.0:
        raise ValueError(f"{path}: time: its median step is {period:g} s: must be within 0 and 1 s")
    shift = time_shift(path, columns[TIME[0]], begin)
    return VibrationSamples(time + shift, values, tuple(sensors), period)
