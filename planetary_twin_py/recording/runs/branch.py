"""A what-if branch: changes to a recorded run, and the resulting run."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from ...model.clock import TICKS
from ...run.commands import CAUSALITIES, Commands
from ...scene import Scene
from ...scene.live import FAULTS, LIVE, PORT_FIELDS
from .intervals import Interval, Intervals
from .origin import Origin, makers_here
from .schedule import Change, RecordedRun, nanoseconds

LONGEST = 3600.0  # [s] of a run that is longer than the recording
NO_COMMANDS = Commands(np.empty(0))


@dataclass(frozen=True)
class Branch:
    """Changes to a recorded run.

    `settings` apply from `start` [s] to the end and override recorded changes of the same names;
    changes of other names apply as recorded. Names are those of `Scene.replace`; names other than
    those of the operating point and the ports require a start of 0. Recorded commands at a shaft
    whose port is set have no effect. The run has the length of the recorded one unless it has a
    `duration` [s]; after the recorded end nothing changes.
    """

    settings: Mapping[str, Any]
    start: float = 0.0
    duration: float | None = None
    run: int | None = None
    """Number of the run in the file, from 1; None is the last."""
    commands: Commands | None = None
    """Commands at the ports, in place of all recorded ones of the same shafts.

    A command acts from the start of the first interval at or after its time. The ports are those
    that the commands require, from the start of the branch on.
    """


def branched(run: RecordedRun, branch: Branch) -> tuple[float, RecordedRun]:
    """Apply a branch to a recorded run.

    Args:
        run: the recorded run.
        branch: the changes.

    Returns:
        Time of the branch [s], at which an interval starts, and the new run.

    Raises:
        ValueError: a setting, the start or the duration is out of range.
    """
    intervals = _stretched(run.intervals, branch.duration)
    last = intervals[-1].begin / TICKS
    if not 0.0 <= branch.start <= last:
        raise ValueError(f"from = {branch.start:g} s: must be within 0 and {last:g} s")
    begins = next(i.begin for i in intervals if i.begin >= round(branch.start * TICKS)) / TICKS
    values, scene = _values(run.origin.scene, branch)
    before = [change for change in run.changes if change.time < begins]
    after = [change for change in run.changes if change.time >= begins]
    if not after or after[0].time > begins:
        in_force = before[-1].values if before else scene.live_values
        after.insert(0, Change(0, _stamp_at(run, intervals, begins), begins, in_force))
    after = _overridden(after, values)
    for change in after:
        scene.replace(**change.values)
    origin = Origin(scene, run.origin.begins, makers_here(), run.origin.damage)
    later = [interval for interval in intervals if interval.begin / TICKS >= begins]
    sides = {PORT_FIELDS[name] for name in values if name in PORT_FIELDS}
    given = dict(run.given) | commanded(run.given, later, sides, branch.commands or NO_COMMANDS)
    given = {stamp: commands for stamp, commands in given.items() if commands}
    return begins, RecordedRun(origin, intervals, before + after, given, run.replaced)


def _overridden(changes: Sequence[Change], values: Mapping[str, Any]) -> list[Change]:
    """Changes with other values from the first on; severities are set once, and may grow then."""
    at_once = {name for name in values if name.startswith(FAULTS)}
    lasting = {name: value for name, value in values.items() if name not in at_once}
    first, *later = (change._replace(values={**change.values, **values}) for change in changes[:1])
    for change in changes[1:]:
        kept = {name: value for name, value in change.values.items() if name not in at_once}
        later.append(change._replace(values=kept | lasting))
    pairs = pairwise([first, *later])
    return [first, *(now for last, now in pairs if _differs(now.values, last.values))]


def _differs(now: Mapping[str, Any], last: Mapping[str, Any]) -> bool:
    """Whether values change anything after the last ones."""
    of_faults = any(name.startswith(FAULTS) for name in now)
    return of_faults or any(now[name] != last.get(name) for name in now)


def commanded(
    recorded: Mapping[int, Mapping[str, float]],
    intervals: Sequence[Interval],
    replaced: Set[str],
    commands: Commands,
) -> dict[int, dict[str, float]]:
    """Commands of intervals, where a course replaces those of some shafts.

    Args:
        recorded: recorded commands, by the stamps of their intervals [ns].
        intervals: intervals in which the course acts.
        replaced: the shafts, "input" and "output".
        commands: the course.

    Returns:
        Commands by stamp [ns].
    """
    waiting, given = deque(commands), dict[int, dict[str, float]]()
    for interval in intervals:
        recorded_values = recorded.get(interval.stamp, {}).items()
        values = {
            name: value for name, value in recorded_values if name.split("_")[0] not in replaced
        }
        while waiting and waiting[0][0] <= interval.begin:
            values |= waiting.popleft()[1].values
        given[interval.stamp] = values
    return given


def _ports(commands: Commands) -> dict[str, str]:
    """The ports that commands require."""
    ports = dict[str, str]()
    for name in commands.names:
        side, quantity = name.split("_")
        port = ports.setdefault(f"drive.{side}.port", CAUSALITIES[quantity])
        if port != CAUSALITIES[quantity]:
            raise ValueError(f"commands: {name}: torque and motion cannot both be given at {side}")
    return ports


def _values(scene: Scene, branch: Branch) -> tuple[dict[str, Any], Scene]:
    """Operating point and ports after the branch as far as it sets them, and the run's scene."""
    required = {} if branch.commands is None else _ports(branch.commands)
    settings = {**required, **branch.settings}
    changed = scene.replace(**settings)
    live = (*LIVE, *scene.severities)
    others = [name for name in settings if name not in live]
    if others and branch.start > 0.0:
        raise ValueError(
            f"{others[0]}: changes the model, which requires from = 0; a later change is possible "
            f"for {', '.join(live)}"
        )
    values = {name: value for name, value in changed.live_values.items() if name in settings}
    return values, changed if branch.start == 0.0 else scene


def _stretched(intervals: Intervals, duration: float | None) -> Intervals:
    """Intervals of total length `duration` [s]: truncated, or extended by the longest interval."""
    if duration is None:
        return intervals
    longest = max(LONGEST, intervals[-1].end / TICKS)
    if not 1.0 / TICKS <= duration <= longest:
        raise ValueError(f"duration = {duration!r} s: must be above 0 and at most {longest:g}")
    end = round(duration * TICKS)
    stretched = [interval for interval in intervals if interval.begin < end]
    length = max(interval.end - interval.begin for interval in intervals)
    while stretched[-1].end < end:
        last = stretched[-1]
        stamp = last.stamp + nanoseconds(length)
        setting = last.tolerance, last.sample_rate
        stretched.append(Interval(last.number + 1, stamp, last.end, last.end + length, *setting))
    excess = stretched[-1].end - end
    stretched[-1] = stretched[-1]._replace(end=end, stamp=stretched[-1].stamp - nanoseconds(excess))
    return Intervals(stretched)


def _stamp_at(run: RecordedRun, intervals: Sequence[Interval], time: float) -> int:
    """ROS time [ns] of the start of an interval at `time` [s]."""
    ends = [interval.stamp for interval in intervals if interval.end / TICKS <= time]
    return ends[-1] if ends else run.origin.begins
