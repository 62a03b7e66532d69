"""Where a recorded run stays at one operating point and has settled there."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

from ...dynamics.speed_loop import bandwidth
from ...twin import TICKS
from ..container.records import RecordingError
from ..ros2.namespaces import choose_namespace
from ..ros2.tape import Tape
from .schedule import Interval, Run, read_runs

SETTLING = 4.0  # periods of the speed loop after a change, beside the ramp to a new speed


def steady_span(path: Path, namespace: str | None = None) -> tuple[float, float] | None:
    """From when to when [s] a recording stays longest at one operating point; None: nowhere."""
    try:
        runs = read_runs(path, choose_namespace(Tape(path).topics, namespace, path), [])
    except RecordingError:  # nothing in it tells from when on an operating point holds
        return None
    _, part = longest_steady_part(runs)
    return (part[0].begin / TICKS, part[-1].end / TICKS) if part else None


def longest_steady_part(runs: list[Run]) -> tuple[Run, list[Interval]]:
    """The longest stretch of any run at one operating point, its settling left out, if any."""
    return max(
        ((run, part) for run in runs for part in steady_parts(run)),
        key=lambda found: length(found[1]),
        default=(runs[0], []),
    )


def steady_parts(run: Run) -> Iterator[list[Interval]]:
    """Intervals from each change, settling left out, to the next."""
    for place, change in enumerate(run.changes):
        later = run.changes[place + 1].time if place + 1 < len(run.changes) else math.inf
        yield between(run, change.time + settling(run, place), later)


def settling(run: Run, place: int) -> float:
    """Time [s] after a change in which the speed loop still moves."""
    control = run.origin.scene.drive.speed_control
    values = run.changes[place].values
    if place:
        before = run.changes[place - 1].values
    elif control.start_speed is None:
        return 0.0  # a run starts in steady running
    else:
        before = values | {"input_speed": control.start_speed}
    ramp = max(abs(values[k] - before[k]) for k in ("input_speed", "second_input_speed"))
    return ramp / control.slew_rate + SETTLING / bandwidth(run.origin.scene)


def between(run: Run, begin: float, end: float) -> list[Interval]:
    """Intervals of a run that lie within `begin` and `end` [s]."""
    ticks = round(begin * TICKS), end * TICKS
    return [i for i in run.intervals if ticks[0] <= i.begin and i.end <= ticks[1]]


def length(intervals: list[Interval]) -> int:
    """From the first to the last [ticks]."""
    return intervals[-1].end - intervals[0].begin if intervals else 0
