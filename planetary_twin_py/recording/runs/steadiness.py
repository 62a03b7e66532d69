"""Parts of a recorded run with a constant operating point, after settling."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from ...model.clock import TICKS
from ...model.gearbox import Gearbox
from ..container.records import RecordingError
from ..ros2.namespaces import namespace_in
from .intervals import Interval
from .schedule import RecordedRun, read_runs

SETTLING = 4.0  # periods of the speed loop after a change, in addition to the speed ramp


def steady_span(path: Path) -> tuple[float, float] | None:
    """Start and end [s] of the longest settled part of a recording; None if there is none."""
    try:
        runs = read_runs(path, namespace_in(path), [])
    except RecordingError:  # the times of its operating points are unknown
        return None
    _, part = longest_steady_part(runs)
    return (part[0].begin / TICKS, part[-1].end / TICKS) if part else None


def longest_steady_part(runs: list[RecordedRun]) -> tuple[RecordedRun, list[Interval]]:
    """The longest settled part of any run at one operating point, with its run; may be empty."""
    return max(
        ((run, part) for run in runs for part in steady_parts(run)),
        key=lambda found: length(found[1]),
        default=(runs[0], []),
    )


def steady_parts(run: RecordedRun) -> Iterator[list[Interval]]:
    """Intervals from each change, after settling, to the next change."""
    for place, change in enumerate(run.changes):
        later = run.changes[place + 1].time if place + 1 < len(run.changes) else math.inf
        yield between(run, change.time + settling(run, place), later)


def settling(run: RecordedRun, place: int) -> float:
    """Settling time [s] of the speed loop after a change."""
    control = run.origin.scene.drive.speed_control
    values = run.changes[place].values
    if place:
        before = run.changes[place - 1].values
    elif control.start_speed is None:
        return 0.0  # a run starts in a steady state
    else:
        before = values | {"input_speed": control.start_speed}
    ramp = max(abs(values[k] - before[k]) for k in ("input_speed", "second_input_speed"))
    return ramp / control.slew_rate + SETTLING / Gearbox(run.origin.scene).bandwidth


def between(run: RecordedRun, begin: float, end: float) -> list[Interval]:
    """Intervals of a run between `begin` and `end` [s]."""
    ticks = round(begin * TICKS), end * TICKS
    return [i for i in run.intervals if ticks[0] <= i.begin and i.end <= ticks[1]]


def length(intervals: Sequence[Interval]) -> int:
    """From the first to the last [ticks]."""
    return intervals[-1].end - intervals[0].begin if intervals else 0
