"""Angle of a shaft from the pulses of a tachometer.

A cubic spline through the pulses follows a speed that changes evenly; lines between them err by
a T^2/8 turns, with the acceleration a and the time T between two pulses (Fyfe and Munck 1997, Mech.
Syst. Signal Process. 11, 187-205). Pulses that are missing or double are found by the time between
their neighbours.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline
from scipy.ndimage import median_filter

Array = NDArray[np.float64]
FEWEST_PULSES = 4  # of a cubic spline
AROUND = 9  # times between pulses whose median is the expected one
DOUBLE = 0.5  # of the expected time, below which a pulse is double
UNCLEAR = 0.25  # distance from a whole number of expected times that is refused
MOST_WRONG = 0.1  # share of pulses that are missing or double


class TachometerAngle(NamedTuple):
    """Angle of a shaft between the first and the last pulse."""

    inside: slice
    """Samples between the first and the last pulse."""
    angle: Array
    """Angle since the first pulse at these samples, continuous over turns [rad], (m,)."""
    missing: tuple[float, ...]
    """Times at which pulses are missing and were added [s]."""
    double: tuple[float, ...]
    """Times of double pulses, which were left out [s]."""


def pulse_times(samples: ArrayLike, sample_rate: float, level: float | None = None) -> Array:
    """Times of the rising edges of a tachometer signal, interpolated between samples.

    Args:
        samples: the signal in any unit, (n,).
        sample_rate: [Hz].
        level: value at which an edge counts; default: half-way between its extremes. The signal
            must fall a tenth of their distance below it before the next edge counts.

    Returns:
        Times since the first sample [s], (pulses,).

    Raises:
        ValueError: a sample is not finite, the sample rate is not positive, or the signal is
            constant.
    """
    values = np.asarray(samples, dtype=np.float64)
    if values.ndim != 1 or not values.size or not np.isfinite(values).all():
        raise ValueError("samples: must be one channel of finite values, at least one")
    if not (np.isfinite(sample_rate) and sample_rate > 0.0):
        raise ValueError(f"sample_rate = {sample_rate:g}: must be positive")
    low, high = float(values.min()), float(values.max())
    middle = 0.5 * (low + high) if level is None else level
    if not low < middle < high:
        raise ValueError(f"level = {middle:g}: must be between the extremes {low:g} and {high:g}")
    # +1 above the level, -1 well below it, and in between what was before.
    state = np.where(values >= middle, 1, np.where(values < middle - 0.1 * (high - low), -1, 0))
    known = np.maximum.accumulate(np.where(state != 0, np.arange(len(state)), 0))
    edges = 1 + np.flatnonzero(np.diff(state[known]) == 2)
    before, after = values[edges - 1], values[edges]
    return (edges - (after - middle) / (after - before)) / sample_rate


def tachometer_angle(
    pulses: ArrayLike, time: ArrayLike, pulses_per_turn: int = 1
) -> TachometerAngle:
    """Angle of a shaft from tachometer pulses, by a cubic spline through them.

    Args:
        pulses: times of the pulses [s], (pulses,), increasing.
        time: of the samples [s], (n,), increasing.
        pulses_per_turn: at equal distances on the shaft.

    Returns:
        The samples between the first and the last pulse, the angle there [rad], and the times of
        pulses that were added and left out [s]. A missing pulse at either end is not noticed.

    Raises:
        ValueError: there are fewer than four pulses, their times are not finite or do not increase,
            no sample is between them, more than a tenth of them are missing or double, or the time
            between two of them is no whole number of those around it.
    """
    stamps, times = np.asarray(pulses, dtype=np.float64), np.asarray(time, dtype=np.float64)
    if pulses_per_turn < 1:
        raise ValueError(f"pulses_per_turn = {pulses_per_turn}: must be at least 1")
    if stamps.ndim != 1 or len(stamps) < FEWEST_PULSES:
        raise ValueError(f"pulses: {stamps.size} values: must be at least {FEWEST_PULSES}")
    for place in np.flatnonzero(~np.isfinite(stamps))[:1]:
        raise ValueError(f"pulses: time {place} is not finite")
    for place in np.flatnonzero(~(np.diff(stamps) > 0.0))[:1]:
        raise ValueError(f"pulses: time {place + 1} is not later than the one before")
    single, double = _without_doubles(stamps)
    counts, missing = _counted(single)
    if len(missing) + len(double) > MOST_WRONG * len(stamps):
        raise ValueError(
            f"pulses: {len(missing)} missing and {len(double)} double of {len(stamps)}: must be at "
            f"most {MOST_WRONG:.0%}"
        )
    begin, end = np.searchsorted(times, single[0]), np.searchsorted(times, single[-1], "right")
    if end <= begin:
        raise ValueError(f"time: no sample between the pulses, {single[0]:g} to {single[-1]:g} s")
    inside = slice(int(begin), int(end))
    angle = CubicSpline(single, counts * (math.tau / pulses_per_turn))(times[inside])
    return TachometerAngle(inside, np.asarray(angle), missing, double)


def _without_doubles(stamps: Array) -> tuple[Array, tuple[float, ...]]:
    """Pulses without double ones, and the times of those."""
    left, double = stamps, list[float]()
    while len(left) > FEWEST_PULSES:
        steps = np.diff(left)
        ratio = steps / _expected(steps)
        shortest = int(ratio.argmin())
        if ratio[shortest] >= DOUBLE:
            break
        # Of the two pulses, leave out that without which the steps are more even.
        candidates = [np.delete(left, shortest + each) for each in (0, 1)]
        uneven = [_unevenness(each, shortest) for each in candidates]
        dropped = shortest + int(uneven[1] <= uneven[0])
        double.append(float(left[dropped]))
        left = candidates[dropped - shortest]
    return left, tuple(sorted(double))


def _unevenness(stamps: Array, place: int) -> float:
    """Largest distance of the steps around a pulse from whole numbers of those expected."""
    steps = np.diff(stamps)
    ratio = steps / _expected(steps)
    away = np.abs(ratio - np.maximum(np.rint(ratio), 1.0))  # the next pulse may be missing
    return float(away[max(place - 2, 0) : place + 2].max())


def _expected(steps: Array) -> Array:
    """Median of the times between pulses around each, (n,); mirrored at the ends."""
    return np.asarray(median_filter(steps, min(AROUND, len(steps)), mode="mirror"))


def _counted(stamps: Array) -> tuple[Array, tuple[float, ...]]:
    """Number of each pulse, with those that are missing, and the times of the missing ones."""
    steps = np.diff(stamps)
    ratio = steps / _expected(steps)
    whole = np.maximum(np.rint(ratio), 1.0)
    for place in np.flatnonzero(np.abs(ratio - whole) > UNCLEAR)[:1]:
        raise ValueError(
            f"pulses: the time after {stamps[place]:.6g} s is {ratio[place]:.3g} times those "
            "around it: must be a whole number; the speed changes too fast, or pulses are wrong"
        )
    missing = [
        float(stamps[place] + steps[place] * part / whole[place])
        for place in np.flatnonzero(whole > 1.0)
        for part in range(1, int(whole[place]))
    ]
    return np.concatenate(([0.0], np.cumsum(whole))), tuple(missing)
