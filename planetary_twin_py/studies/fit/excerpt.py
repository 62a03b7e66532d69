"""The part of a recording that is fitted, and the start of its simulation."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...model.clock import TICKS
from ...recording.container.records import RecordingError
from ...recording.ros2.namespaces import namespace_in
from ...recording.ros2.topics import STATE, WAVEFORM
from ...recording.runs.intervals import Interval
from ...recording.runs.origin import Measured
from ...recording.runs.schedule import (
    Change,
    RecordedRun,
    messages_of,
    nanoseconds,
    read_runs,
    stamp_of,
)
from ...recording.runs.steadiness import between, length, longest_steady_part, settling
from ...run.twin import Twin
from ...scene import Scene

LONGEST = 1.0  # [s] used by default
HISTORY = 2.0  # [s] before the excerpt that are simulated as recorded; if longer, see `_reference`
LEAD = 0.1  # [s] simulated before the excerpt in that case, for the transient of the start
FEWEST = 5  # intervals needed to estimate the noise


@dataclass(frozen=True)
class Excerpt:
    """Recorded intervals of one run, with everything needed to simulate them."""

    scene: Scene
    """The scene with the operating point at `begins`."""
    begins: float
    """Time of the recorded run at which a simulation starts [s]."""
    before: tuple[Interval, ...]
    """Recorded intervals after `begins` that are simulated but not fitted."""
    intervals: tuple[Interval, ...]
    states: tuple[Any, ...]
    """The GearboxState of each interval."""
    changes: tuple[Change, ...]
    """Changes of the operating point after `begins`."""
    blocks: tuple[Any, ...]
    """Blocks of the waveform; empty if not requested."""
    remarks: tuple[str, ...]
    """Warnings about the file."""
    measured: bool
    """Whether it is a table of a rig, whose operating points need not follow each other."""

    @property
    def start(self) -> float:
        """Start of the first interval [s]."""
        return self.intervals[0].begin / TICKS

    @property
    def end(self) -> float:
        """End of the last interval [s]."""
        return self.intervals[-1].end / TICKS

    @property
    def held_from(self) -> float:
        """Time from which the operating point at the start applies, not before `begins` [s]."""
        times = (c.time for c in self.changes if self.begins < c.time <= self.start)
        return max(times, default=self.begins)

    @property
    def tolerance(self) -> float:
        """Largest tolerance of any interval."""
        return max(interval.tolerance for interval in self.intervals)

    @property
    def segments(self) -> tuple[float, ...]:
        """Times at which the operating point changes within the excerpt [s]."""
        return tuple(c.time for c in self.changes if self.start < c.time < self.end)


def read_excerpt(
    path: Path,
    namespace: str | None = None,
    begin: float | None = None,
    end: float | None = None,
    waveform: bool = False,
) -> Excerpt:
    """Read a part of the longest run of a recording.

    Args:
        path: an .mcap file, or its folder.
        namespace: namespace of the gearbox, if the recording has several.
        begin: start [s]. Without `begin` and `end`, the longest settled part of any run with a
            constant operating point is used, up to `LONGEST`.
        end: end [s].
        waveform: whether to read the waveform.

    Returns:
        The excerpt.

    Raises:
        RecordingError: no run has a scene, or there are too few intervals.
    """
    remarks: list[str] = []
    chosen = namespace_in(path, namespace)
    runs = read_runs(path, chosen, remarks)
    if begin is None and end is None:
        run, intervals = longest_steady_part(runs)
        within = [i for i in intervals if i.end <= intervals[0].begin + LONGEST * TICKS]
        intervals = intervals[: max(FEWEST, len(within))]
        remarks.extend(_omitted_points(run, intervals))
    else:
        run = max(runs, key=lambda run: length(run.intervals))
        intervals = between(run, begin or 0.0, math.inf if end is None else end)
    if len(intervals) < FEWEST:
        asked = "" if begin is None and end is None else " from --from to --to"
        longest = max((run.intervals[-1].end for run in runs), default=0) / TICKS
        raise RecordingError(
            f"{path}: {len(intervals)} intervals{asked}, must be at least {FEWEST}; "
            f"the longest run ends at {longest:g} s"
        )
    measured = isinstance(run.origin.makers, Measured)
    reference = None if measured else _reference(run, intervals[0].begin / TICKS)
    stamps = {interval.stamp for interval in intervals} | {reference.stamp if reference else -1}
    states = {
        stamp_of(message): message
        for _, message in messages_of(path, chosen, (STATE,), [])
        if stamp_of(message) in stamps
    }
    scene, begins = _start(run, reference and states[reference.stamp], reference)
    last = intervals[-1].end / TICKS
    return Excerpt(
        scene=scene,
        begins=begins,
        before=()
        if measured
        else tuple(i for i in between(run, begins, math.inf) if i.end <= intervals[0].begin),
        intervals=tuple(intervals),
        states=tuple(states[interval.stamp] for interval in intervals),
        changes=tuple(change for change in run.changes if begins <= change.time < last),
        blocks=tuple(_blocks(path, chosen, intervals)) if waveform else (),
        remarks=tuple(remarks),
        measured=measured,
    )


def _omitted_points(run: RecordedRun, intervals: list[Interval]) -> Iterator[str]:
    """Warning if the longest steady part does not contain all operating points of a run."""
    last = run.intervals[-1].end / TICKS
    points = sum(change.time < last for change in run.changes)
    if intervals and points > 1:
        yield (
            f"only 1 of {points} operating points is used, {intervals[0].begin / TICKS:g} to "
            f"{intervals[-1].end / TICKS:g} s of {last:g} s; use --from and --to to select more"
        )


def _reference(run: RecordedRun, begin: float) -> Interval | None:
    """The last interval before `begin` that ends in steady running; None if none is needed."""
    if begin <= HISTORY:
        return None
    until = begin - LEAD
    for place in reversed(range(len(run.changes))):
        if run.changes[place].time < until:
            if until >= run.changes[place].time + settling(run, place):
                break
            until = run.changes[place].time
    ends = [interval.end / TICKS for interval in run.intervals]
    place = bisect_right(ends, until)
    return run.intervals[place - 1] if place else None


def _start(run: RecordedRun, state: Any, reference: Interval | None) -> tuple[Scene, float]:
    """Scene and time at which steady running has the recorded angles, or the start of the run."""
    scene = run.origin.scene
    if reference is None:
        return scene, 0.0
    times = [change.time for change in run.changes]
    values = run.changes[bisect_right(times, reference.begin / TICKS) - 1].values
    steady = scene.replace(**values, **{"drive.speed_control.start_speed": None})
    begins = reference.end / TICKS - _since_start_angles(steady, state)
    if begins <= 0.0:
        return scene, 0.0
    return steady, begins


def _since_start_angles(scene: Scene, state: Any) -> float:
    """Time [s] since the gears, and as closely as possible the motor, had the angles of a start.

    Every run starts at the same angles, so a run started at that time has the recorded phases. The
    result is 0 if the angles were not measured.
    """
    first_window = Twin(scene).advance(1.0 / TICKS)
    start_angle = {body: first_window.angle[k] for k, body in enumerate(first_window.bodies)}
    member = scene.drive.input.member
    turned = (getattr(state, f"{member}_angle") - start_angle[member]) / (2.0 * math.pi)
    speed = getattr(state, f"{member}_speed") / (2.0 * math.pi)
    relative_angle = (
        state.sun_angle - start_angle["sun"] - state.carrier_angle + start_angle["carrier"]
    )
    rate = state.sun_speed - state.carrier_speed
    if not np.isfinite([turned, speed, relative_angle, rate, state.mesh_frequency]).all():
        return 0.0  # not measured
    if speed == 0.0 or state.mesh_frequency == 0.0:
        return 0.0
    since = (turned * math.copysign(1.0, speed)) % 1.0 / abs(speed)
    cycles = scene.gearset.teeth.sun * (relative_angle - rate * since) / (2.0 * math.pi)
    return since + (cycles - round(cycles)) * math.copysign(1.0, rate) / float(state.mesh_frequency)


def _blocks(path: Path, namespace: str, intervals: list[Interval]) -> Iterator[Any]:
    """Blocks of the waveform within the intervals."""
    begin, end = intervals[0].begin / TICKS, intervals[-1].end / TICKS
    stamps = intervals[0].stamp - nanoseconds(intervals[0].end - intervals[0].begin), intervals[-1]
    for _, message in messages_of(path, namespace, (WAVEFORM,), []):
        within = stamps[0] <= stamp_of(message) <= stamps[1].stamp
        if within and begin - 1e-9 <= message.start_time <= end:
            yield message
