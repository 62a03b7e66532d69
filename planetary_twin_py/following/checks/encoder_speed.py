"""Compares the speed that the encoders show with the measured speed.

Counts per turn that are wrong by the same factor for both encoders, and a wrong sample rate, leave
the ratio of their turns correct. A compliance and the size of a crack are wrong by this factor.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np

from ..input_error import InputError
from ..transmission_error import Counts
from ..turning import Turning

EVERY = 1.0  # [s] between samples that are compared
LEAST = 1.0  # turns of the input in a span that is compared
LONGEST = 60.0  # [s] of a span; a train that turns less meanwhile is at rest
SPANS = 3  # whose median counts, because turns may be lost
NEAR = 0.02  # relative deviation within which two speeds agree
OFFSET = 0.05  # [s] by which the clocks of encoders and readings may differ
GAP = 1.0  # [s] between two speeds above which a span is not compared


@dataclass
class EncoderSpeed:
    """Compares the first spans in which the input turns; samples are `period` [s] apart."""

    counts_per_turn: tuple[int, int]
    period: float
    _points: deque[tuple[float, float]] = field(default_factory=lambda: deque(maxlen=600))
    """Times [s] and angles of the input [rad], the first one the begin of the present span."""
    _slot: int | None = None  # of the last point
    _ratios: list[float] = field(default_factory=list)

    def add(self, sample: Counts, counts: Counts) -> None:
        """Add numbers of samples, (n,), and counts of both encoders, (n, 2)."""
        if len(self._ratios) >= SPANS or not len(sample):
            return
        slots = np.floor(sample * self.period / EVERY).astype(np.int64)
        before = np.concatenate([[slots[0] - 1 if self._slot is None else self._slot], slots[:-1]])
        for k in np.flatnonzero(slots > np.maximum.accumulate(before)):
            turns = int(counts[k, 0]) / self.counts_per_turn[0]
            self._points.append((float(sample[k]) * self.period, 2.0 * math.pi * turns))
            self._slot = int(slots[k])

    def judge(self, until: float, turning: Callable[[float, float], Turning]) -> None:
        """Compare the spans that end by a time [s] with the speed that `turning` returns.

        Raises `InputError` if they differ.
        """
        while len(self._ratios) < SPANS and len(self._points) > 1 and self._points[1][0] <= until:
            begin, end = self._points[0], self._points[1]
            course = turning(begin[0], end[0])
            measured = _turned(course, begin[0], end[0])
            if abs(measured) < 2.0 * math.pi * LEAST and end[0] - begin[0] < LONGEST:
                del self._points[1]  # the span becomes longer
                continue
            self._points.popleft()
            if abs(measured) >= 2.0 * math.pi * LEAST and _is_steady(course, begin[0], end[0]):
                self._ratios.append((end[1] - begin[1]) / measured)
            if len(self._ratios) == SPANS:
                speed = float(np.median(np.abs(course.speed)))
                self._check(float(np.median(self._ratios)), speed)

    def remarks(self) -> Iterator[str]:
        """A line if the encoders have not been compared with a measured speed."""
        if len(self._ratios) < SPANS:
            yield (
                "encoders: their counts per turn and their sample rate are not checked: this needs "
                f"a nearly constant measured speed in {SPANS} spans of a turn and at least "
                f"{EVERY:g} s"
            )

    def _check(self, ratio: float, speed: float) -> None:
        if abs(ratio - 1.0) < NEAR:
            return
        first, second = self.counts_per_turn
        raise InputError(
            f"encoders: by their counts, the input turns {ratio:.4g} times as fast as by the "
            f"measured speed, {speed:.4g} rad/s; are counts per turn of {first} and {second}, a "
            f"sample rate of {1.0 / self.period:.6g} Hz, the directions and the unit of the speed "
            "right?"
        )


def _is_steady(course: Turning, begin: float, end: float) -> bool:
    """Whether the speed changes so slowly that an `OFFSET` hardly matters."""
    inside = (course.time > begin) & (course.time < end)
    first, second = (float(half.mean()) for half in np.array_split(course.speed[inside], 2))
    rate = (second - first) / (0.5 * (end - begin))  # [rad/s^2]
    return abs(rate) * OFFSET <= 0.5 * NEAR * abs(0.5 * (first + second))


def _turned(course: Turning, begin: float, end: float) -> float:
    """Measured angle of the input [rad]; NaN if the speed is not known throughout."""
    time = course.time
    if len(time) < 2 or time[0] > begin + GAP or time[-1] < end - GAP or np.diff(time).max() > GAP:
        return math.nan
    inside = (time > begin) & (time < end)
    times = np.concatenate([[begin], time[inside], [end]])
    return float(np.trapezoid(np.interp(times, time, course.speed), times))
