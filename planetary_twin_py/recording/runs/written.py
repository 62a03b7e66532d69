"""Simulates a run and writes it, interval by interval."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ...model.clock import TICKS
from .compose import Composer
from .intervals import Interval
from .resimulation import steps
from .schedule import RecordedRun, nanoseconds

_PAUSE = 1_000_000_000  # [ns], larger differences of stamps and simulated time are pauses


def write_run(composer: Composer, run: RecordedRun) -> Iterator[float]:
    """Simulate `run` and write its messages.

    Args:
        composer: writes the messages.
        run: origin, intervals and changes.

    Yields:
        Simulated time after each interval [s].
    """
    composer.begin(run.origin)
    stamp = run.origin.begins
    values = run.origin.scene.live_values
    for interval, changes, window in steps(run):
        for change in changes:
            values = values | change.values
            composer.point(values, change.time, change.stamp)
        first = _stamp_within(interval, stamp, window.waveform.time)
        composer.window(window, interval.stamp, first)
        stamp = interval.stamp
        yield window.end


def _stamp_within(interval: Interval, before: int, times: Any) -> int:
    """ROS time [ns] of the first of the samples at `times` [s], as in the nodes.

    `before` is the ROS time of the end of the previous interval [ns].
    """
    if not len(times):
        return interval.stamp
    begin, end = interval.begin / TICKS, interval.end / TICKS
    span = interval.stamp - before
    paused = span - nanoseconds(interval.end - interval.begin) > _PAUSE
    pace = 1e9 if paused else span / (end - begin)
    return interval.stamp + round((times[0] - end) * pace)
