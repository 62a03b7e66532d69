"""Converts measured waveforms, of one file or several, to one recording."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.integrate import cumulative_trapezoid

from ...model.clock import TICKS
from ...recording.tables.sensor import Sensor, read_sensor
from ...recording.tables.shaft import MeasuredSpeed, Pulses, read_pulses, read_speed
from ...recording.tables.source import Source
from ...recording.tables.waveform_recording import (
    STEP,
    MeasuredTurning,
    MeasuredWaveform,
    write_waveforms,
)
from ...scene import Scene
from ...units.conversion import column_to_si
from ..sampling.even_steps import at_equal_steps, drift_remark, drifts, resampled
from ..shaft.shaft_angle import (
    Tachometer,
    Turned,
    angle_from_pulses,
    angle_from_speed,
    pulse_stamps,
)
from .sensor import input_angle
from .signal import Array
from .waveform_map import Channel, Shaft, WaveformMap

_HALF = 0.5  # of an interval


class Imported(NamedTuple):
    """The new recording."""

    file: Path
    sensors: dict[str, MeasuredWaveform]
    length: float
    """Of the recording [s]."""
    speed: tuple[float, float]
    """Lowest and highest speed of the input shaft [rad/s]."""
    remarks: tuple[str, ...]

    def lines(self, out: Path) -> Iterator[str]:
        """What is in the recording.

        Args:
            out: what it is called.
        """
        low, high = (30.0 / math.pi * one for one in self.speed)
        yield f"{out}: {self.length:.6g} s, input speed {low:.6g} to {high:.6g} rpm"
        for name, one in self.sensors.items():
            count, rate = len(one.values), 1.0 / one.period
            yield f"sensors/{name}: {count} samples at {rate:.9g} Hz [{one.unit}]"


def import_waveforms(table: Path, given: WaveformMap, scene: Scene, out: Path) -> Imported:
    """Convert measured waveforms to a recording.

    Time 0 of the recording is the first sample, or the begin of the measured speed if that is
    later. Samples without a measured speed are left out, with a remark.

    Args:
        table: file with the channels whose map names no other.
        given: what the channels are.
        scene: of the gearbox; its speed is used if none was measured.
        out: a bag folder, or a file that ends in .mcap.

    Raises:
        ValueError: see `read_sensor` and `angle_from_pulses`.
        OSError: a file cannot be read, or the recording cannot be written.
    """
    sensors = {
        name: _evenly(read_sensor(_file(table, channel), channel.wanted()))
        for name, channel in given.sensors.items()
    }
    remarks = [f"{name}: {line}" for name, one in sensors.items() for line in one.remarks]
    first = next(iter(sensors.values()))
    begin = min(float(one.time[0]) for one in sensors.values())
    end = max(float(one.time[-1]) for one in sensors.values())
    step = STEP / TICKS
    count = math.floor((end - begin) / step + _HALF)
    times: Array = np.array(begin + step * np.arange(count + 1), dtype=np.float64)
    if count < 1:
        raise ValueError(f"{table}: {end - begin:g} s of samples: must be at least {step:g} s")
    grid = first._replace(time=times, samples=np.zeros(len(times)), remarks=())
    turned, pulses = _turned(table, given, scene, grid)
    remarks += turned.remarks
    grid = grid._replace(time=times[turned.inside])
    begin = float(grid.time[0])
    angle = input_angle(scene, turned.angle, grid.time - begin, _shaft(given))
    torque = {
        side: _means(_file(table, channel), channel, grid)
        for side, channel in given.torques.items()
    }
    waveforms = {name: _within(one, grid) for name, one in sensors.items()}
    for name, one in waveforms.items():
        if not len(one.values):
            raise ValueError(f"{table}: sensors.{name}: has no sample while the speed is known")
    stamps = None if pulses is None else pulses[pulses >= begin] - begin
    turning = MeasuredTurning(angle, torque)
    file = write_waveforms(waveforms, stamps, turning, scene, table.name, out)
    speeds = np.diff(angle) / step
    span = float(speeds.min()), float(speeds.max())
    length = float(grid.time[-1]) - begin
    return Imported(file, waveforms, length, span, tuple(dict.fromkeys(remarks)))


def _turned(
    table: Path, given: WaveformMap, scene: Scene, grid: Sensor
) -> tuple[Turned, Array | None]:
    """Angle of a shaft at the ends of intervals, and times of pulses if there is a tachometer."""
    if given.tachometer is not None:
        found, about = _pulses(table, given.tachometer), given.tachometer
        read = Tachometer(about.pulses_per_turn, about.threshold)
        return angle_from_pulses(grid, found, read), pulse_stamps(grid, found, read)
    if given.speed is not None:
        return angle_from_speed(grid, _speed(table, given.speed)), None
    speed = scene.operating_point.input_speed
    angle = speed * (grid.time - grid.time[0])
    line = (
        f"no speed was measured: that of the scene is assumed, {30.0 / math.pi * speed:.6g} rpm "
        "of the input; state speed or tachometer in the file of --sensors"
    )
    return Turned(slice(0, len(grid.time)), angle, (line,)), None


def _shaft(given: WaveformMap) -> str:
    stated = given.tachometer or given.speed
    return "input" if stated is None else stated.shaft


def _pulses(table: Path, shaft: Shaft) -> Pulses:
    return read_pulses(Source(_file(table, shaft), shaft.column_name), shaft.sample_rate)


def _speed(table: Path, shaft: Shaft) -> MeasuredSpeed:
    return read_speed(Source(_file(table, shaft), shaft.column_name), shaft.sample_rate)


def _file(table: Path, channel: Channel) -> Path:
    """The file of a channel, beside the table."""
    return table if channel.file is None else table.parent / channel.file


def _evenly(sensor: Sensor) -> Sensor:
    """A sensor at equal steps."""
    if not drifts(sensor.time):
        return sensor._replace(time=at_equal_steps(sensor.time))
    return sensor._replace(
        time=at_equal_steps(sensor.time),
        samples=resampled(sensor.samples, sensor.time),
        remarks=(*sensor.remarks, drift_remark(sensor.time)),
    )


def _within(sensor: Sensor, grid: Sensor) -> MeasuredWaveform:
    """Samples while the angle is known; times count from its begin."""
    period = float(sensor.time[-1] - sensor.time[0]) / (len(sensor.time) - 1)
    begin, end = (float(one) for one in grid.time[[0, -1]])
    kept = (sensor.time >= begin - 1e-6 * period) & (sensor.time < end + STEP / TICKS)
    first = max(float(sensor.time[kept][0]) - begin, 0.0) if kept.any() else 0.0
    return MeasuredWaveform(sensor.unit, first, period, sensor.samples[kept])


def _means(file: Path, channel: Channel, grid: Sensor) -> Array:
    """Means of a torque over the intervals between the times of a grid [N m]."""
    sensor = read_sensor(file, channel.wanted())
    torque = column_to_si(sensor.samples, "N m" if sensor.unit == "-" else sensor.unit, "N m")
    if sensor.time[0] > grid.time[0] + STEP / TICKS or sensor.time[-1] < grid.time[-2]:
        raise ValueError(
            f"{file}: {sensor.name}: from {sensor.time[0]:.6g} to {sensor.time[-1]:.6g} s: must "
            f"cover {grid.time[0]:.6g} to {grid.time[-1]:.6g} s"
        )
    total = cumulative_trapezoid(torque, sensor.time, initial=0)
    times = np.clip(grid.time, sensor.time[0], sensor.time[-1])
    known = np.interp(times, sensor.time, total)
    return np.asarray(np.diff(known) / np.maximum(np.diff(times), 1e-12))
