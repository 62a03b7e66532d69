"""Runs that are recorded, simulated again interval by interval."""

from __future__ import annotations

from bisect import bisect_left
from collections import OrderedDict, deque
from collections.abc import Iterator
from typing import Any

from ..twin import TICKS, Twin
from ..window import Window
from .schedule import Change, Interval, Run, stamp_of
from .topics import STATE, WAVEFORM

KEPT = 1000  # intervals that wait for their messages


class Again:
    """Runs simulated again, interval by interval, as far as they are asked for."""

    def __init__(self, runs: list[Run], remarks: list[str]) -> None:
        self._stamps = [interval.stamp for run in runs for interval in run.intervals]
        self._begins = [run.origin.begins for run in runs for _ in run.intervals]
        self._windows = _windows(runs, remarks)
        self._made: OrderedDict[int, tuple[Interval, Window]] = OrderedDict()
        self._count = 0

    def interval_of(self, topic: str, message: Any) -> tuple[Interval, Window] | None:
        """What a message tells of, simulated again; None where that cannot be."""
        stamp = stamp_of(message)
        place = bisect_left(self._stamps, stamp)
        if place == len(self._stamps) or stamp < self._begins[place]:
            return None
        if topic == WAVEFORM:  # stamped with its first sample
            for candidate in (place, place + 1):  # where it is rounded down to the end before
                found = self._at(candidate)
                if found and _holds(found[1], message):
                    return found
            return None
        return self._at(place) if self._stamps[place] == stamp else None

    def _at(self, place: int) -> tuple[Interval, Window] | None:
        while self._count <= place:
            made = next(self._windows, None)
            if made is None:
                break
            self._made[self._count] = made
            self._count += 1
            if len(self._made) > KEPT:
                self._made.popitem(last=False)
        return self._made.get(place)


def _holds(window: Window, block: Any) -> bool:
    """Whether a block of samples is that of an interval."""
    time = window.waveform.time
    return len(time) > 0 and bool(time[0] == block.start_time)


def _windows(runs: list[Run], remarks: list[str]) -> Iterator[tuple[Interval, Window]]:
    """Every recorded interval simulated again, run after run."""
    for run in runs:
        twin: Twin | None = None
        changes = deque(run.changes)
        number, reached = run.intervals[0].number - 1, 0
        for interval in run.intervals:
            if twin is None:
                twin = Twin(run.origin.scene, interval.sample_rate, interval.tolerance)
            missing = interval.number - number - 1
            if missing * (interval.end - interval.begin) != interval.begin - reached:
                remarks.append(
                    f"{missing} messages of {STATE} are missing before {twin.time:g} s, and what "
                    "they told is not known: what follows cannot be simulated again"
                )
                return
            for _ in range(missing):
                _advance(twin, interval, changes)
            yield interval, _advance(twin, interval, changes)
            number, reached = interval.number, interval.end


def _advance(twin: Twin, interval: Interval, changes: deque[Change]) -> Window:
    """The next interval, with what changes at its begin."""
    while changes and changes[0].time <= twin.time:
        twin.set(**changes.popleft().values)
    twin.set_tolerance(interval.tolerance)
    twin.set_sample_rate(interval.sample_rate)
    return twin.advance((interval.end - interval.begin) / TICKS)
