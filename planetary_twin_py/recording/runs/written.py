"""Simulates a run and writes it, interval by interval."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...model.clock import TICKS
from .compose import Composer
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
        times = window.waveform.time
        first = stamp_within(interval.begin, interval.end, stamp, interval.stamp, times)
        composer.window(window, interval.stamp, first)
        stamp = interval.stamp
        yield window.end


def stamp_within(begin: int, end: int, before: int, stamp: int, times: np.ndarray) -> int:
    """ROS time of the first sample of an interval, as in the nodes.

    Args:
        begin: start of the interval [ticks].
        end: its end [ticks].
        before: ROS time of the end of the previous interval [ns].
        stamp: ROS time of its end [ns].
        times: its sample times [s].

    Returns:
        The time [ns]; that of the end if there are no samples.
    """
    if not len(times):
        return stamp
    span = stamp - before
    paused = span - nanoseconds(end - begin) > _PAUSE
    pace = 1e9 if paused else span / (end / TICKS - begin / TICKS)
    return int(stamp + round((times[0] - end / TICKS) * pace))
