"""What would have been: a recorded run simulated again with other values from an instant on."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import yaml

from ..scene import TUNABLES, OperatingPoint, Scene, SceneError
from ..twin import TICKS
from .again import steps
from .bag import BagWriter
from .compose import Composer
from .origin import Origin, makers_here
from .reader import SCENE_ATTACHMENT
from .schedule import Change, Interval, Run, messages_of, read_runs, without_gaps
from .tape import Tape
from .topics import STATE

BRANCH_ATTACHMENT = "branch.yaml"
LONGEST = 3600.0  # [s] of a run that goes on beyond what is recorded
_PAUSE = 1_000_000_000  # [ns] by which stamps run ahead of simulated time only where it stood


@dataclass(frozen=True)
class Branch:
    """How a run is to differ from the recorded one.

    `settings` hold from `start` [s] on, whatever the recorded changes after it say of the same
    names; those of other names happen as recorded. Names are those of `Scene.replace`; what is not
    of the operating point can only hold from 0 on. A run is as long as the recorded one unless it
    has a `duration` [s]; beyond the recorded end nothing changes any more.
    """

    settings: Mapping[str, Any]
    start: float = 0.0
    duration: float | None = None
    run: int | None = None
    """Which of the runs in the file, from 1; the last unless given."""


@dataclass
class Made:
    """What was written; `remarks` says in lines what of the recording could not be used."""

    file: Path
    begins: float
    """Simulated instant from which the settings hold: where an interval began [s]."""
    end: float
    """Of the run [s]."""
    remarks: list[str] = field(default_factory=list)


def resimulate(
    path: Path,
    namespace: str,
    branch: Branch,
    folder: Path,
    progress: Callable[[float, float], None] = lambda time, end: None,
) -> Made:
    """Simulate a run of the gearbox in `namespace` again, and write it into a new `folder`.

    Up to the branch the messages are as recorded, on the machine that recorded them to the last
    bit. `progress` hears the simulated time reached, and that of the end [s].

    Raises:
        RecordingError: nothing in the recording can be simulated again.
        ValueError: a setting, the start, the duration or the run cannot be.
        FileExistsError: `folder` exists.
        OSError: it cannot be written.
    """
    remarks: list[str] = []
    recorded = _chosen(read_runs(path, namespace, remarks), branch.run, remarks)
    recorded = replace(recorded, intervals=without_gaps(recorded, remarks))
    begins, run = branched(recorded, branch)
    _, state = next(messages_of(path, namespace, (STATE,), []))
    bag = BagWriter(folder)
    end = run.intervals[-1].end / TICKS
    try:
        _attach(bag, path, run.origin.scene, branch, begins)
        composer = Composer(bag, Tape(path).topics.values(), namespace, state.header.frame_id)
        for time in write_run(composer, run):
            progress(time, end)
    finally:  # what is there is true, however far it goes
        bag.close()
    return Made(bag.file, begins, end, remarks)


def branched(run: Run, branch: Branch) -> tuple[float, Run]:
    """The instant [s] of the branch, and the run that follows from it.

    Raises:
        ValueError: a setting, the start or the duration cannot be.
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
        in_force = before[-1].values if before else scene.operating_point.model_dump()
        after.insert(0, Change(0, _stamp_at(run, intervals, begins), begins, in_force))
    after = [change._replace(values=change.values | values) for change in after]
    after = after[:1] + [now for last, now in pairwise(after) if now.values != last.values]
    for change in after:
        scene.replace(**change.values)
    origin = Origin(scene, run.origin.begins, makers_here())
    return begins, Run(origin, intervals, before + after)


def write_run(composer: Composer, run: Run) -> Iterator[float]:
    """Simulate `run` and write all that it shows; yields the time reached [s]."""
    composer.begin(run.origin)
    stamp = run.origin.begins
    for interval, changes, window in steps(run):
        for change in changes:
            composer.point(OperatingPoint(**change.values), change.time, change.stamp)
        first = _stamp_within(interval, stamp, window.waveform.time)
        composer.window(window, interval.stamp, first)
        stamp = interval.stamp
        yield window.end


def _chosen(runs: list[Run], number: int | None, remarks: list[str]) -> Run:
    if number is None:
        if len(runs) > 1:
            remarks.append(f"holds {len(runs)} runs, and the last is simulated: --run chooses")
        return runs[-1]
    if not 1 <= number <= len(runs):
        raise ValueError(f"run = {number}: must be within 1 and {len(runs)}")
    return runs[number - 1]


def _values(scene: Scene, branch: Branch) -> tuple[dict[str, float], Scene]:
    """Values of the operating point that hold from the branch on, and the scene of the run."""
    changed = scene.replace(**branch.settings)
    tuned = [name for name in branch.settings if name in TUNABLES]
    others = [name for name in branch.settings if name not in TUNABLES]
    if others and branch.start > 0.0:
        raise SceneError(
            f"{others[0]}: makes another model, which runs from = 0 only; from then on can change "
            f"{', '.join(TUNABLES)}"
        )
    values = {name: getattr(changed.operating_point, name) for name in tuned}
    return values, changed if branch.start == 0.0 else scene


def _stretched(intervals: list[Interval], duration: float | None) -> list[Interval]:
    """The intervals that make `duration` [s]: cut off, or with more like the longest at the end."""
    if duration is None:
        return intervals
    longest = max(LONGEST, intervals[-1].end / TICKS)
    if not 1.0 / TICKS <= duration <= longest:
        raise ValueError(f"duration = {duration!r} s: must be above 0 and at most {longest:g}")
    end = round(duration * TICKS)
    kept = [interval for interval in intervals if interval.begin < end]
    length = max(interval.end - interval.begin for interval in intervals)
    while kept[-1].end < end:
        last = kept[-1]
        stamp = last.stamp + _nanoseconds(length)
        setting = last.tolerance, last.sample_rate
        kept.append(Interval(last.number + 1, stamp, last.end, last.end + length, *setting))
    over = kept[-1].end - end
    kept[-1] = kept[-1]._replace(end=end, stamp=kept[-1].stamp - _nanoseconds(over))
    return kept


def _stamp_at(run: Run, intervals: list[Interval], time: float) -> int:
    """ROS time [ns] of the instant at which an interval begins."""
    ends = [interval.stamp for interval in intervals if interval.end / TICKS <= time]
    return ends[-1] if ends else run.origin.begins


def _stamp_within(interval: Interval, before: int, times: Any) -> int:
    """ROS time [ns] of the first of the samples at `times` [s], as the nodes tell it.

    `before` is that of the end of the interval before.
    """
    if not len(times):
        return interval.stamp
    begin, end = interval.begin / TICKS, interval.end / TICKS
    span = interval.stamp - before
    stood = span - _nanoseconds(interval.end - interval.begin) > _PAUSE
    pace = 1e9 if stood else span / (end - begin)
    return interval.stamp + round((times[0] - end) * pace)


def _nanoseconds(ticks: int) -> int:
    return round(ticks * 1_000_000_000 / TICKS)


def _attach(bag: BagWriter, path: Path, scene: Scene, branch: Branch, begins: float) -> None:
    """Say beside the messages what the gearbox is, and that this is no recording of a live one."""
    told = {
        "recording": path.name,
        "run": branch.run,
        "from": begins,
        "set": {name: str(value) for name, value in branch.settings.items()},
    }
    for name, content in (
        (SCENE_ATTACHMENT, scene.model_dump(mode="json")),
        (BRANCH_ATTACHMENT, told),
    ):
        text = yaml.safe_dump(content, sort_keys=False)
        bag.attach(name, text.encode(), "application/yaml")
