"""Levels of a sensor over a tenth of a second: what plotters show of a waveform."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
INTERVAL = 0.1  # [s]
FEWEST_CYCLES = 4  # of the mesh in an interval: twice the half width of the line of a Hann window
RESOLVED = 0.4  # share of the sample rate that sensors pass
CONSTANT = 1e-12  # of the largest magnitude: a deviation below it is rounding


class Levels(NamedTuple):
    """Levels over one interval, in the unit of the sensor."""

    end: float
    """End of the interval [s]."""
    interval: float
    """Its length [s]."""
    mean: float
    """Mean."""
    rms: float
    """Rms of the deviation from the mean."""
    peak: float
    """Largest magnitude of the deviation from the mean."""
    kurtosis: float
    """Fourth moment over the square of the second [-]; NaN if the samples are constant."""
    mesh_line: float
    """Amplitude at the mesh frequency; NaN if it is not resolved."""
    clipped: int
    """Samples at the ends of the range."""


class LevelMeter:
    """Computes levels of successive samples; intervals begin at multiples of their length.

    Args:
        period: sample period [s].
        limit: of the range of the sensor, in its unit; None: it has none.
    """

    def __init__(self, period: float, limit: float | None) -> None:
        self._period = period
        self._limit = math.inf if limit is None else limit
        self._size = max(round(INTERVAL / period), 1)
        self._next = 0  # number of the first sample that waits
        self._values: list[Array] = []
        self._knots: list[tuple[float, float]] = []  # time [s] and mesh cycles

    def turn(self, start: float, end: float, frequency: float) -> None:
        """Add a span of time with its mean mesh frequency [Hz]; spans follow one another.

        Args:
            start: of the span [s].
            end: of the span [s].
            frequency: number of teeth that pass a mesh, over the length of the span [Hz].
        """
        if not self._knots:
            self._knots.append((start, 0.0))
        self._knots.append((end, self._knots[-1][1] + frequency * (end - start)))

    def add(self, first: int, values: Array) -> list[Levels]:
        """Add successive samples, and return the levels of the intervals that they complete.

        After a gap, intervals restart.

        Args:
            first: number of the first sample since time 0.
            values: samples, (n,).
        """
        if first != self._next + sum(map(len, self._values)):
            self._next, self._values = first, []
        self._values.append(values)
        found, end = [], first + len(values)
        while (self._next // self._size + 1) * self._size <= end:
            found += self._taken((self._next // self._size + 1) * self._size)
        return found

    def _taken(self, end: int) -> list[Levels]:
        """Levels of the samples up to number `end`, unless the interval began before the first."""
        first, self._next = self._next, end
        waiting, count = np.concatenate(self._values), end - first
        self._values, values = [waiting[count:]], waiting[:count]
        cycles = self._cycles(first, end)
        if count < self._size:
            return []
        deviation = values - values.mean()
        rms = float(np.sqrt(np.mean(deviation**2)))
        varies = rms > CONSTANT * float(np.abs(values).max())
        kurtosis = float(np.mean(deviation**4)) / rms**4 if varies else math.nan
        return [
            Levels(
                end * self._period,
                count * self._period,
                float(values.mean()),
                rms,
                float(np.abs(deviation).max()),
                kurtosis,
                line_amplitude(deviation, cycles),
                int(np.count_nonzero(np.abs(values) >= self._limit)),
            )
        ]

    def _cycles(self, first: int, end: int) -> Array:
        """Mesh cycles at the samples; knots before them are dropped."""
        time, cycles = np.array(self._knots, dtype=np.float64).reshape(-1, 2).T
        at = self._period * np.arange(first, end)
        kept = max(int(np.searchsorted(time, end * self._period)) - 1, 0)
        self._knots = self._knots[kept:]
        return np.interp(at, time, cycles) if len(time) else np.full(len(at), math.nan)


def line_amplitude(deviation: Array, cycles: Array) -> float:
    """Amplitude of the line at the mesh frequency, by a Hann window; NaN if it is not resolved.

    Args:
        deviation: samples without their mean, (n,).
        cycles: mesh cycles at the samples, (n,).
    """
    turned = abs(float(cycles[-1] - cycles[0]))
    if not FEWEST_CYCLES <= turned <= RESOLVED * len(cycles):
        return math.nan
    window = np.hanning(len(cycles) + 1)[:-1]
    line = np.sum(window * deviation * np.exp(-2j * math.pi * cycles))
    return float(2.0 * np.abs(line) / window.sum())
