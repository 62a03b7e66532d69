"""The part of a recording that is looked at, and what its simulation begins from."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...recording.container.records import RecordingError
from ...recording.ros2.namespaces import choose_namespace
from ...recording.ros2.tape import Tape
from ...recording.ros2.topics import STATE, WAVEFORM
from ...recording.runs.schedule import Change, Interval, Run, messages_of, read_runs, stamp_of
from ...recording.runs.steadiness import between, length, longest_steady_part, settling
from ...scene import Scene
from ...twin import TICKS, Twin

LONGEST = 1.0  # [s] that is looked at unless more is asked for
HISTORY = 2.0  # [s] before it that are simulated as recorded; of more, only the last part
LEAD = 0.1  # [s] simulated before it then, for what is left of the start
FEWEST = 5  # intervals that noise can be seen in


@dataclass(frozen=True)
class Stretch:
    """Recorded intervals of one run, in their order, and all that is needed to simulate them."""

    scene: Scene
    """At the operating point in force at `begins`."""
    begins: float
    """Simulated instant of the recorded run at which a simulation starts [s]; 0 is its start."""
    before: tuple[Interval, ...]
    """Recorded intervals from `begins` on that are simulated and not looked at."""
    intervals: tuple[Interval, ...]
    states: tuple[Any, ...]
    """The GearboxState of each interval."""
    changes: tuple[Change, ...]
    """Operating points that come into force from `begins` on."""
    blocks: tuple[Any, ...]
    """Blocks of the waveform; empty unless asked for."""
    remarks: tuple[str, ...]
    """What of the file could not be read."""

    @property
    def start(self) -> float:
        """[s]"""
        return self.intervals[0].begin / TICKS

    @property
    def end(self) -> float:
        """[s]"""
        return self.intervals[-1].end / TICKS

    @property
    def held_from(self) -> float:
        """From when the operating point at the start is in force, as far as is simulated [s]."""
        times = (c.time for c in self.changes if self.begins < c.time <= self.start)
        return max(times, default=self.begins)

    @property
    def tolerance(self) -> float:
        """The loosest in force."""
        return max(interval.tolerance for interval in self.intervals)

    @property
    def segments(self) -> tuple[float, ...]:
        """Instants at which another operating point comes into force within the stretch [s]."""
        return tuple(c.time for c in self.changes if self.start < c.time < self.end)


def read_stretch(
    path: Path,
    namespace: str | None = None,
    begin: float | None = None,
    end: float | None = None,
    waveform: bool = False,
) -> Stretch:
    """Read from `begin` to `end` [s] of the longest run in the recording at `path`.

    Without them: the longest stretch of any run on which the operating point stays the same, its
    settling left out, up to `LONGEST`.

    Raises:
        RecordingError: there is no run with its scene, or no such stretch in it.
    """
    remarks: list[str] = []
    chosen = choose_namespace(Tape(path).topics, namespace, path)
    runs = read_runs(path, chosen, remarks)
    if begin is None and end is None:
        run, intervals = longest_steady_part(runs)
        within = [i for i in intervals if i.end <= intervals[0].begin + LONGEST * TICKS]
        intervals = intervals[: max(FEWEST, len(within))]
        remarks.extend(_left_out(run, intervals))
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
    reference = _reference(run, intervals[0].begin / TICKS)
    stamps = {interval.stamp for interval in intervals} | {reference.stamp if reference else -1}
    states = {
        stamp_of(message): message
        for _, message in messages_of(path, chosen, (STATE,), [])
        if stamp_of(message) in stamps
    }
    scene, begins = _start(run, reference and states[reference.stamp], reference)
    last = intervals[-1].end / TICKS
    return Stretch(
        scene=scene,
        begins=begins,
        before=tuple(i for i in between(run, begins, math.inf) if i.end <= intervals[0].begin),
        intervals=tuple(intervals),
        states=tuple(states[interval.stamp] for interval in intervals),
        changes=tuple(change for change in run.changes if begins <= change.time < last),
        blocks=tuple(_blocks(path, chosen, intervals)) if waveform else (),
        remarks=tuple(remarks),
    )


def _left_out(run: Run, intervals: list[Interval]) -> Iterator[str]:
    """A line on the operating points of a run that its longest steady part leaves out."""
    last = run.intervals[-1].end / TICKS
    points = sum(change.time < last for change in run.changes)
    if intervals and points > 1:
        yield (
            f"1 of {points} operating points is looked at, {intervals[0].begin / TICKS:g} to "
            f"{intervals[-1].end / TICKS:g} s of {last:g} s; choose more with --from and --to"
        )


def _reference(run: Run, begin: float) -> Interval | None:
    """The last interval before `begin` at whose end the train runs steadily; None: none needed."""
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


def _start(run: Run, state: Any, reference: Interval | None) -> tuple[Scene, float]:
    """Scene and instant at which steady running has the recorded angles; else the run's start."""
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
    """Time [s] since the teeth, and as nearly as may be the motor, stood as a run starts.

    Each start stands at the same angles, so a start at that instant has the recorded phases; 0
    where a rig has not measured them.
    """
    first = Twin(scene).advance(1.0 / TICKS)
    at = {body: first.angle[k] for k, body in enumerate(first.bodies)}
    member = scene.drive.input.member
    turned = (getattr(state, f"{member}_angle") - at[member]) / (2.0 * math.pi)
    speed = getattr(state, f"{member}_speed") / (2.0 * math.pi)
    meshed = state.sun_angle - at["sun"] - state.carrier_angle + at["carrier"]
    rate = state.sun_speed - state.carrier_speed
    if not np.isfinite([turned, speed, meshed, rate, state.mesh_frequency]).all():
        return 0.0  # not measured
    if speed == 0.0 or state.mesh_frequency == 0.0:
        return 0.0
    since = (turned * math.copysign(1.0, speed)) % 1.0 / abs(speed)
    cycles = scene.gearset.teeth.sun * (meshed - rate * since) / (2.0 * math.pi)
    return since + (cycles - round(cycles)) * math.copysign(1.0, rate) / float(state.mesh_frequency)


def _blocks(path: Path, namespace: str, intervals: list[Interval]) -> Iterator[Any]:
    """Blocks of the waveform within the intervals."""
    begin, end = intervals[0].begin / TICKS, intervals[-1].end / TICKS
    stamps = intervals[0].stamp - (intervals[0].end - intervals[0].begin) // 1000, intervals[-1]
    for _, message in messages_of(path, namespace, (WAVEFORM,), []):
        within = stamps[0] <= stamp_of(message) <= stamps[1].stamp
        if within and begin - 1e-9 <= message.start_time <= end:
            yield message
