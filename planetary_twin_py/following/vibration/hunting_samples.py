"""Cuts samples of vibration into hunting periods, by the measured speed."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..train import FollowedTrain
from ..turning import Turning

Array = NDArray[np.float64]

SLOWEST = 0.05  # share of the speed of the scene, below which the train counts as at rest


class HuntingPeriod(NamedTuple):
    """Samples of a hunting period."""

    begin: float
    """[s]."""
    end: float
    """[s]."""
    time: Array
    """Stamps of the samples [s], (n,), increasing."""
    values: Array
    """Samples in the units of the channels, (n, channels)."""
    course: Turning
    """Speed and torque, in the period at least."""


@dataclass
class SampleCounters:
    """Numbers of samples that were used, or not used."""

    used: int = 0
    """Samples that are used."""
    late: int = 0
    """Samples that arrived after their hunting period or too long before the readings of the speed,
    occur twice, or are not finite."""


class HuntingSamples:
    """Keeps samples until their hunting period is complete; increases `counters`."""

    def __init__(self, train: FollowedTrain, period: float, counters: SampleCounters) -> None:
        self._period, self._counters = period, counters
        self._angle = 2.0 * math.pi * train.hunting_cycles / abs(float(train.cycles))
        self._usual = self._angle / train.speed  # [s]
        self._longest = self._usual / SLOWEST  # [s]
        self._most = round(2.0 * self._longest / period)  # samples that wait
        self._waiting: list[tuple[Array, Array]] = []
        self._begin = math.nan  # start of the present hunting period [s]
        self._until = math.nan  # time of the last call of `periods` [s]
        self._sampled = math.inf, -math.inf  # first and last sample [s]
        self._speed_from = math.nan  # first reading of the speed [s]

    def add(self, time: Array, values: Array) -> None:
        """Add samples in the units of the channels, (n, channels), with stamps [s], (n,)."""
        while self._waits_too_long():
            self._counters.late += len(self._waiting.pop(0)[0])
        usable = np.isfinite(time) & np.isfinite(values).all(axis=1) & ~(time < self._begin)
        self._counters.late += int(np.sum(~usable))
        self._waiting.append((time[usable], values[usable]))
        known = time[np.isfinite(time)]
        if len(known):
            first, last = self._sampled
            self._sampled = min(first, float(known.min())), max(last, float(known.max()))

    def _waits_too_long(self) -> bool:
        """Whether there are no readings, or their end is long before the newest samples."""
        if sum(len(part) for part, _ in self._waiting) <= self._most:
            return False
        times = self._waiting[0][0]
        return not (len(times) and times.max() <= self._until)

    def periods(
        self, until: float, turning: Callable[[float, float], Turning]
    ) -> Iterator[HuntingPeriod]:
        """Remove and return the hunting periods that end by a time [s] with known speed."""
        if until == self._until:
            return
        self._until = until
        if math.isnan(self._speed_from):
            known = turning(-math.inf, until).time
            self._speed_from = float(known[0]) if len(known) else math.nan
        while self._waiting:
            if math.isnan(self._begin) and not self._start(turning(-math.inf, until)):
                return
            course = turning(self._begin, min(until, self._begin + self._longest))
            end = course.end_of(self._angle, self._begin)
            if end is None:
                if until > self._begin + self._longest:  # the train is at rest
                    self._pop(until)
                    self._begin = until
                return
            newest = max((float(time.max()) for time, _ in self._waiting if len(time)), default=0.0)
            if end > until or newest < end:
                return
            begin, self._begin = self._begin, end
            yield HuntingPeriod(begin, end, *self._pop(end), course)

    def _start(self, course: Turning) -> bool:
        """Start at the first sample whose speed is known; return whether there is one."""
        firsts = [float(time.min()) for time, _ in self._waiting if len(time)]
        if not (firsts and len(course.time)):
            return False
        self._begin = max(min(firsts), float(course.time[0]))
        self._pop(self._begin)
        return True

    def _pop(self, until: float) -> tuple[Array, Array]:
        """Remove and return the samples before a time, in order, without duplicates."""
        time = np.concatenate([part for part, _ in self._waiting])
        values = np.concatenate([part for _, part in self._waiting])
        order = np.argsort(time, kind="stable")
        time, values = time[order], values[order]
        distinct = np.diff(time, prepend=-np.inf) > 0.5 * self._period
        self._counters.late += int(np.sum(~distinct))
        time, values = time[distinct], values[distinct]
        ready = time < until
        self._waiting = [(time[~ready], values[~ready])] if not ready.all() else []
        self._counters.used += int(np.sum(ready))
        return time[ready], values[ready]

    def why_none(self) -> str:
        """Why no hunting period is complete so far."""
        if math.isnan(self._speed_from):
            return "vibration: not judged without readings of the speed"
        (first, last), begin, end = self._sampled, self._speed_from, self._until
        shared = min(last, end) - max(first, begin)
        spans = (
            f"vibration: not judged: samples from {first:.2f} to {last:.2f} s and readings of the "
            f"speed from {begin:.2f} to {end:.2f} s"
        )
        if shared <= 0.0:
            return f"{spans} do not overlap"
        return (
            f"{spans} overlap for {shared:.2f} s; a hunting period takes {self._usual:.2f} s at "
            "the speed of the scene"
        )
