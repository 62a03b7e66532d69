"""Angle of a shaft at the samples of a signal, from a speed or pulses with times of their own.

Nothing is assumed outside of what was measured: samples before and after it are left out. Between
two speeds the angle is a cubic polynomial whose slopes are these speeds, which is exact while a
speed changes evenly.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.integrate import cumulative_trapezoid
from scipy.interpolate import CubicHermiteSpline

from ...recording.tables.sensor import Sensor
from ...recording.tables.shaft import MeasuredSpeed, Pulses
from .tachometer import Array, pulse_times, tachometer_angle

MOST_NAMED = 5  # times of wrong pulses in a remark


class Turned(NamedTuple):
    """Angle of a shaft."""

    inside: slice
    """Samples at which it is known."""
    angle: Array
    """At these samples [rad], (m,), continuous over turns."""
    remarks: tuple[str, ...]


class Tachometer(NamedTuple):
    """How the signal of a tachometer is read."""

    pulses_per_turn: int = 1
    level: float | None = None
    """Value at which an edge counts; None is half-way between the extremes."""


def angle_from_speed(sensor: Sensor, measured: MeasuredSpeed) -> Turned:
    """Angle from a speed at another rate.

    Args:
        sensor: the samples.
        measured: the speed of the shaft.

    Raises:
        ValueError: its times do not overlap those of the samples, or only one of both has dates.
    """
    time = measured.time + _shift(sensor, measured.date)
    inside, remarks = _overlap(sensor, time, "speed")
    turned = cumulative_trapezoid(measured.speed, time, initial=0)
    angle = CubicHermiteSpline(time, turned, measured.speed)(sensor.time[inside])
    return Turned(inside, np.asarray(angle), (*measured.remarks, *remarks))


def angle_from_pulses(sensor: Sensor, measured: Pulses, tachometer: Tachometer) -> Turned:
    """Angle from the pulses of a tachometer, see `tachometer_angle`.

    Args:
        sensor: the samples.
        measured: times of pulses, or a waveform.
        tachometer: how it is read.

    Raises:
        ValueError: see `pulse_times` and `tachometer_angle`; or the times do not overlap.
    """
    stamps = pulse_stamps(sensor, measured, tachometer)
    _, remarks = _overlap(sensor, stamps, "tachometer")
    found = tachometer_angle(stamps, sensor.time, tachometer.pulses_per_turn)
    remarks += tuple(
        f"tachometer: {len(times)} pulses are {kind}, {done}: {_listed(times)}"
        for kind, done, times in (
            ("missing", "and were added", found.missing),
            ("double", "and were left out", found.double),
        )
        if times
    )
    return Turned(found.inside, found.angle, remarks)


def pulse_stamps(sensor: Sensor, measured: Pulses, tachometer: Tachometer) -> Array:
    """Times of pulses on the clock of the samples [s], (pulses,), with double ones.

    Args:
        sensor: the samples.
        measured: times of pulses, or a waveform.
        tachometer: how it is read.

    Raises:
        ValueError: see `pulse_times`; there are fewer than two pulses, or only one has dates.
    """
    stamps = measured.times
    if stamps is None:
        edges = pulse_times(measured.samples, measured.rate, tachometer.level)
        stamps = measured.begin + edges
    if len(stamps) < 2:
        raise ValueError(f"tachometer: {len(stamps)} pulses; is the threshold right?")
    return stamps + _shift(sensor, measured.date)


def _overlap(sensor: Sensor, time: Array, name: str) -> tuple[slice, tuple[str, ...]]:
    """Samples within the measured times, and a remark if others are left out."""
    own, other = sensor.time[[0, -1]], time[[0, -1]]
    half = 0.5 * float(own[1] - own[0]) / (len(sensor.time) - 1)
    begin = int(np.searchsorted(sensor.time, other[0] - 1e-9 * half))
    end = int(np.searchsorted(sensor.time, other[1] + 1e-9 * half, "right"))
    spans = f"{name} from {other[0]:.6g} to {other[1]:.6g} s"
    if end - begin < 2:
        raise ValueError(
            f"{spans}, samples from {own[0]:.6g} to {own[1]:.6g} s: these do not overlap; both "
            "must count from the same instant"
        )
    if (begin, end) == (0, len(sensor.time)):
        return slice(begin, end), ()
    return slice(begin, end), (
        f"{spans}, samples from {own[0]:.6g} to {own[1]:.6g} s: the part in both is analysed",
    )


def _shift(sensor: Sensor, date: np.datetime64 | None) -> float:
    """Time between the zeros of two tables with dates [s]; 0 if neither has dates."""
    if (sensor.date is None) != (date is None):
        raise ValueError(
            "one table has dates and the other has seconds: both must count from the same instant"
        )
    if sensor.date is None or date is None:
        return 0.0
    return float((date - sensor.date) / np.timedelta64(1, "ns")) * 1e-9


def _listed(times: tuple[float, ...]) -> str:
    """The first times, for a remark."""
    shown = ", ".join(f"{one:.6g}" for one in times[:MOST_NAMED])
    return f"{shown}{', ...' if len(times) > MOST_NAMED else ''} s"


def constant(sensor: Sensor, speed: float) -> Turned:
    """Angle at a constant speed.

    Args:
        sensor: the samples.
        speed: of the shaft [rad/s].

    Raises:
        ValueError: the speed is 0 or not finite.
    """
    if not math.isfinite(speed) or speed == 0.0:
        raise ValueError(f"speed = {speed:g} rad/s: must not be 0")
    return Turned(slice(0, len(sensor.time)), speed * (sensor.time - sensor.time[0]), ())
