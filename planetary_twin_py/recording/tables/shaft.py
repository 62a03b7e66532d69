"""Reads the measured speed of a shaft, or the pulses of its tachometer, from any table."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...units.conversion import column_to_si, has_unit
from .chosen_column import chosen, state_units
from .measurements import TIME, Array, naming, read_channels
from .sensor import Wanted, read_sensor, unknown_unit
from .source import Source
from .speed_faults import SpeedColumn, jump_remarks


class MeasuredSpeed(NamedTuple):
    """Speed of a shaft at times of its own."""

    time: Array
    """[s], (n,), increasing."""
    speed: Array
    """[rad/s], (n,)."""
    date: np.datetime64 | None
    """Of time 0 if the time stamps are dates."""
    remarks: tuple[str, ...]


class Pulses(NamedTuple):
    """Signal of a tachometer: times of pulses, or a waveform at equal steps."""

    times: Array | None
    """Of the pulses [s], (pulses,); None of a waveform."""
    samples: Array
    """Of a waveform, (n,)."""
    begin: float
    """Time of its first sample [s]."""
    rate: float
    """Its sample rate [Hz]."""
    date: np.datetime64 | None
    """Of time 0 if the time stamps are dates."""


def constant_speed(text: str) -> float | None:
    """A speed that an option states as a number with a unit [rad/s]; None if it names a column.

    Args:
        text: such as "998 rpm".

    Raises:
        ValueError: the unit is not one of speed.
    """
    if not has_unit(text) or "[" in text:
        return None
    from ...units.conversion import to_si

    return float(str(to_si(text, "rad/s")))


def read_speed(source: Source, sample_rate: float | None) -> MeasuredSpeed:
    """Read a measured speed with its own times.

    Args:
        source: the column.
        sample_rate: [Hz], for a column without times; None if it has them.

    Raises:
        ValueError: see `read_sensor`; or the unit is not one of speed.
        OSError: the file cannot be read.
    """
    sensor = read_sensor(source.file, Wanted(source.column, sample_rate=sample_rate))
    remarks = list(sensor.remarks)
    if sensor.unit == "-":
        remarks.append(unknown_unit(sensor.name, sensor.name))
    with naming(source.file):
        unit = "rad/s" if sensor.unit == "-" else sensor.unit
        speed = column_to_si(sensor.samples, unit, "rad/s")
    shown = SpeedColumn(sensor.name, sensor.name, sensor.samples)
    remarks += jump_remarks(shown, sensor.time, 0)
    return MeasuredSpeed(sensor.time, speed, sensor.date, tuple(remarks))


def read_pulses(source: Source, sample_rate: float | None) -> Pulses:
    """Read a tachometer: a column whose values all increase is a list of times of pulses.

    Args:
        source: the column.
        sample_rate: [Hz], for a waveform without times; None if it has them.

    Raises:
        ValueError: see `read_sensor`; or values increase, but are no times.
        OSError: the file cannot be read.
    """
    columns = read_channels(source.file)
    every = list(columns)
    name = chosen(source.file, "--tachometer", source.column, every)
    state_units(source.file, columns, "--tachometer", name, source.column)
    column = columns[name]
    values = column.in_si(TIME[0], "s") if name == TIME[0] else column.as_given(name)
    known = values[np.isfinite(values)]
    if len(known) < 2 or not (np.diff(known) > 0.0).all():
        sensor = read_sensor(source.file, Wanted(source.column, sample_rate=sample_rate))
        rate = (len(sensor.time) - 1) / float(sensor.time[-1] - sensor.time[0])
        return Pulses(None, sensor.samples, float(sensor.time[0]), rate, sensor.date)
    if name != TIME[0] and column.unit is None and TIME[0] in columns:
        raise ValueError(
            f"{source.file}: {name}: increases in every row, so it is no pulse train; if these are "
            f"times of pulses, state --tachometer '{name} [s]'"
        )
    with naming(source.file):
        stamps = known if name == TIME[0] else column_to_si(known, column.unit or "s", "s")
    return Pulses(stamps, np.empty(0), 0.0, 0.0, column.begin)
