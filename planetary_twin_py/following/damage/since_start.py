"""What is found of readings that count for damage since a program has started."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .rows import Rows

Array = NDArray[np.float64]
Counts = NDArray[np.int64]
Mask = NDArray[np.bool_]


class Point(NamedTuple):
    """A reading."""

    time: float
    """[s]."""
    torque: float
    """[N m]."""
    speed: float
    """[rad/s]."""
    oil: float
    """[K]."""


@dataclass
class SinceStart:
    """Findings on some gearboxes, (n,) each."""

    counted: Counts
    """Readings in the sums."""
    time: Array
    """Their time [s]."""
    without_sd: Counts
    """Of them, those without the standard deviation of the torque."""
    gaps: Counts
    longest_gap: Array
    """[s]."""
    again: Counts
    """Readings whose stamps are not later than the last one in the sums."""
    outside: Counts
    first_outside: list[Point | None]
    """The first reading that the map does not cover; its torque is the largest within it."""
    last: list[Point | None]
    """The last reading in the sums."""
    rates: Array
    """Rates of damage at that one [1/s], (n, parts); NaN before."""
    refusal: str = ""
    """Why the map has no rate for a reading within its range; empty if there was none."""

    @classmethod
    def of(cls, count: int, parts: int) -> SinceStart:
        """Findings before the first reading."""

        def zeros() -> Counts:
            return np.zeros(count, dtype=np.int64)

        return cls(
            zeros(), np.zeros(count), zeros(), zeros(), np.zeros(count), zeros(), zeros(),
            [None] * count, [None] * count, np.full((count, parts), math.nan),
        )  # fmt: skip

    def note(self, rows: Rows, counted: Mask, beyond: Mask, reach: Array, rates: Array) -> None:
        """Note some rows, (m, n); rates are (m, n, parts)."""
        self.counted += counted.sum(axis=0)
        self.time += np.where(counted, rows.step, 0.0).sum(axis=0)
        self.without_sd += (counted & np.isnan(rows.torque_sd)).sum(axis=0)
        self.gaps += rows.gap.sum(axis=0)
        gap = np.where(rows.gap, rows.step, 0.0).max(axis=0)
        self.longest_gap = np.maximum(self.longest_gap, gap)
        self.again += rows.again.sum(axis=0)
        self.outside += beyond.sum(axis=0)
        for n in np.flatnonzero(beyond.any(axis=0)).tolist():
            if self.first_outside[n] is None:
                row = int(np.argmax(beyond[:, n]))
                self.first_outside[n] = _point(rows, row, n)._replace(torque=float(reach[row, n]))
        last = len(counted) - 1 - np.argmax(counted[::-1], axis=0)
        some = np.flatnonzero(counted.any(axis=0))
        self.rates[some] = rates[last[some], some]
        for n in some.tolist():
            self.last[n] = _point(rows, int(last[n]), n)


def _point(rows: Rows, row: int, n: int) -> Point:
    return Point(*(float(each[row, n]) for each in (rows.time, rows.torque, rows.speed, rows.oil)))
