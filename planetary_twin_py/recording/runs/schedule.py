"""The runs in a recording: origins, intervals and parameter changes."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

from ...durability.damage_state import Replacement
from ...model.clock import TICKS
from ...scene import Scene
from ...scene.live import PORT_FIELDS
from ...text.escaping import one_line
from ..container.records import RecordingError
from ..ros2.decode import described_messages
from ..ros2.given import causality, joint_names, values_by_joint, values_of_shafts
from ..ros2.no_run import no_run_yet
from ..ros2.point import OIL, values_of_point
from ..ros2.topics import DAMAGE, GIVEN, ORIGIN, POINT, STATE
from ..ros2.typestore import is_recorded
from .commands_by_stamp import CommandsByStamp
from .intervals import Interval, Intervals, in_ticks
from .origin import Origin, read_origin

# For measured runs, which have no such settings: the defaults of `planetary-twin simulate`.
TOLERANCE = 1e-4
SAMPLE_RATE = 50_000.0  # [Hz]
_LONGEST = 300  # characters of a remark


class Change(NamedTuple):
    """Operating point, ports and severities, and the simulated time [s] from which they apply."""

    number: int  # of its message
    stamp: int  # [ns]
    time: float
    values: dict[str, Any]  # by the arguments of `Twin.set`; of severities those that are set


@dataclass
class RecordedRun:
    """A run, from time zero to the last interval before the next start."""

    origin: Origin
    intervals: Intervals = field(default_factory=Intervals)
    changes: list[Change] = field(default_factory=list)
    given: Mapping[int, Mapping[str, float]] = field(default_factory=dict)
    """Commands at the ports in an interval, by its stamp [ns]."""
    replaced: tuple[Replacement, ...] = ()
    """Parts that were replaced during the run, in order."""

    @property
    def missing(self) -> int:
        """Number of intervals between the first and the last that are not recorded."""
        return self.intervals[-1].number - self.intervals[0].number + 1 - len(self.intervals)


def read_runs(path: Path, namespace: str, remarks: list[str]) -> list[RecordedRun]:
    """Read the runs of a gearbox.

    Args:
        path: path of the recording.
        namespace: namespace of the gearbox.
        remarks: warnings about incomplete runs are appended.

    Raises:
        RecordingError: no run is recorded from its start.
    """
    collected = _Collector(remarks)
    take: dict[str, Callable[[Any], None]] = {
        ORIGIN: collected.origin,
        POINT: collected.change,
        GIVEN: collected.command,
        STATE: collected.interval,
        DAMAGE: collected.damage,
    }
    for name, message in messages_of(path, namespace, tuple(take), remarks):
        take[name](message)
    return collected.runs(path, remarks)


def without_gaps(run: RecordedRun, remarks: list[str]) -> Iterator[Interval]:
    """Intervals of a run, with inferred intervals in place of missing messages.

    An inferred interval has the length and settings of the next recorded one. Where that is
    inconsistent, or the settings before were others, the result ends, with a warning in `remarks`.
    """
    number, reached, stamp = run.intervals[0].number - 1, 0, run.origin.begins
    settings_before = None
    for interval in run.intervals:
        length, missing = interval.end - interval.begin, interval.number - number - 1
        settings = interval.tolerance, interval.sample_rate
        unchanged = settings_before in (None, settings)
        if missing * length != interval.begin - reached or (missing and not unchanged):
            remarks.append(
                f"{missing} messages of {STATE} are missing before {reached / TICKS:g} s, cannot "
                "be inferred: the rest of the run cannot be simulated again"
            )
            return
        for n in range(1, missing + 1):
            end = reached + n * length
            between = stamp + (interval.stamp - stamp) * n // (missing + 1)
            yield Interval(number + n, between, end - length, end, *settings, False)
        yield interval
        number, reached, stamp = interval.number, interval.end, interval.stamp
        settings_before = settings


def messages_of(
    path: Path, namespace: str, names: tuple[str, ...], remarks: list[str]
) -> Iterator[tuple[str, Any]]:
    """Read messages of several topics, in the order of the log times of each file."""
    wanted = {f"{namespace}/{name}": name for name in names}
    for described, record in described_messages(path, wanted.__contains__, remarks):
        yield wanted[described.topic], described.message(record.data)


class _Collector:
    """Collects messages, and assigns them to runs."""

    def __init__(self, remarks: list[str]) -> None:
        self._remarks = remarks
        self._origins: dict[int, Origin] = {}
        self._changes: list[Change] = []
        self._intervals = Intervals()
        self._commands = CommandsByStamp()  # by joint
        self._damage: list[Any] = []  # messages with parts that were replaced

    def origin(self, message: Any) -> None:
        try:
            origin = read_origin(message.data)
        except RecordingError as reason:  # other runs may have a valid origin
            self._remarks.append(one_line(f"a message of {ORIGIN} is skipped: {reason}", _LONGEST))
            return
        self._origins[origin.begins] = origin

    def change(self, message: Any) -> None:
        # What was no parameter of the version that recorded stayed as its scene has it.
        values = values_of_point(message)
        change = Change(message.sequence, stamp_of(message), message.simulated_time, values)
        self._changes.append(change)

    def interval(self, message: Any) -> None:
        for name in ("tolerance", "sample_rate"):
            if not is_recorded(message, name):
                raise RecordingError(
                    f"{STATE} has no field {name} in this recording: nothing of it can be "
                    "simulated again"
                )
        number, before = message.sequence, self._intervals[-1] if self._intervals else None
        self._intervals.append(
            Interval(
                number,
                stamp_of(message),
                *in_ticks(number, message.simulated_time, message.interval, before),
                _value_or_default(message.tolerance, TOLERANCE),
                _value_or_default(message.sample_rate, SAMPLE_RATE),
            )
        )

    def damage(self, message: Any) -> None:
        if len(message.replaced):
            self._damage.append(message)

    def command(self, message: Any) -> None:
        self._commands.add(stamp_of(message), values_by_joint(message))

    def runs(self, path: Path, remarks: list[str]) -> list[RecordedRun]:
        found = {ORIGIN: len(self._origins), STATE: len(self._intervals)}
        runs, skipped = self._runs_from_start()
        if skipped:
            remarks.append(f"{skipped} intervals of a run whose start or origin is not recorded")
        if runs and not self._changes:
            raise RecordingError(
                f"{path}: has no message of the topic {POINT}, which holds the operating point of "
                "its runs, so nothing can be simulated again"
            )
        self._assign_changes(runs, remarks)
        self._assign_commands(runs)
        self._assign_replacements(runs)
        for run in runs:
            run.changes = _with_ports(run)
        runs = [run for run in runs if run.intervals]
        if not runs:
            usual = "recordings started later by ~/start or ~/snapshot have no start of a run"
            raise RecordingError(
                no_run_yet(path, found)
                or f"{path}: has no run with its start, its origin ({ORIGIN}) and its changes, so "
                f"nothing can be simulated again; {remarks[0] if remarks else usual}"
            )
        return runs

    def _runs_from_start(self) -> tuple[list[RecordedRun], int]:
        """Runs that are recorded from their start, and the number of intervals of others."""
        begins = sorted(self._origins)
        starts: list[tuple[int, Origin | None]] = []
        before = 0
        for number, interval in enumerate(self._intervals):
            if interval.begin == 0:  # the newest origin since the previous interval
                place = bisect_right(begins, interval.stamp)
                known = place and begins[place - 1] >= before
                starts.append((number, self._origins[begins[place - 1]] if known else None))
            before = interval.stamp
        runs, skipped = list[RecordedRun](), 0
        for number, origin in reversed(starts):
            intervals = self._intervals.cut(number)
            if origin is None:
                skipped += len(intervals)
            else:
                runs.append(RecordedRun(origin, intervals))
        return runs[::-1], skipped + len(self._intervals)

    def _assign_commands(self, runs: list[RecordedRun]) -> None:
        """Assign commands to runs by their stamps, which are those of the intervals."""
        given = {run.origin.begins: CommandsByStamp() for run in runs}
        for stamp, values in self._commands.items():
            if run := self._run_at(stamp, runs):
                of_shafts = values_of_shafts(values, joint_names(run.origin.scene))
                given[run.origin.begins].add(stamp, of_shafts)
        for run in runs:
            run.given = given[run.origin.begins]

    def _assign_replacements(self, runs: list[RecordedRun]) -> None:
        """Assign the parts that were replaced in each run: those after the log of its origin."""
        for message in self._damage:
            if run := self._run_at(stamp_of(message), runs):
                before = 0 if run.origin.damage is None else len(run.origin.damage.replaced)
                log = zip(
                    message.replaced, message.replaced_at, message.replaced_damage, strict=True
                )
                every = [
                    Replacement(part, float(at), 0.0, float(damage)) for part, at, damage in log
                ]
                run.replaced = tuple(every[before:])

    def _run_at(self, stamp: int, runs: list[RecordedRun]) -> RecordedRun | None:
        """The run in progress at `stamp` [ns]; None after an origin that another one replaced.

        A twin that is paused at time zero publishes its origin again when it goes on.
        """
        begins = sorted(self._origins)
        place = bisect_right(begins, stamp)
        candidates = (run for run in runs if place and run.origin.begins == begins[place - 1])
        return next(candidates, None)

    def _assign_changes(self, runs: list[RecordedRun], remarks: list[str]) -> None:
        """Assign the changes to runs by their stamps, which never decrease."""
        for change in self._changes:
            if run := self._run_at(change.stamp, runs):
                run.changes.append(_settable(change, run.origin.scene))
        for before, after in pairwise(self._changes):
            if after.number != before.number + 1:
                remarks.append(
                    f"{after.number - before.number - 1} messages of {POINT} are missing: "
                    f"after {before.time:g} s, that run cannot be simulated again"
                )
                _remove_uncertain(runs, before, after)
        for run in runs:
            if run.intervals and not any(change.time == 0.0 for change in run.changes):
                remarks.append(
                    f"the message of {POINT} at the start of a run is missing: that run cannot be "
                    "simulated again"
                )
                run.intervals = Intervals()


def _settable(change: Change, scene: Scene) -> Change:
    """A change without the temperature of the oil if that is a state."""
    if scene.thermal is None:
        return change
    values = {name: value for name, value in change.values.items() if name != OIL}
    return change._replace(values=values)


def _with_ports(run: RecordedRun) -> list[Change]:
    """Changes of a run, with those of its ports.

    Earlier versions did not record ports. Only a brake changed them, and an interval from which on
    they differed has commands at all given ports.
    """
    if not run.given or any(PORT_FIELDS.keys() & change.values.keys() for change in run.changes):
        return run.changes
    waiting, changes = deque(run.changes), list[Change]()
    before = of_scene = run.origin.scene.drive.ports
    stamp = run.origin.begins
    for interval in run.intervals:
        begin = interval.begin / TICKS
        while waiting and waiting[0].time <= begin:
            changes.append(waiting.popleft())
        given = run.given.get(interval.stamp)
        ports = of_scene._replace(**causality(given)) if given else before
        if ports != before:
            values = {name: getattr(ports, side) for name, side in PORT_FIELDS.items()}
            changes.append(
                Change(0, stamp, begin, (changes[-1].values if changes else {}) | values)
            )
        before, stamp = ports, interval.stamp
    return [*changes, *waiting]


def _value_or_default(value: float, default: float) -> float:
    return default if math.isnan(value) else value


def nanoseconds(ticks: int) -> int:
    """Convert ticks of simulated time to [ns]."""
    return round(ticks * 1_000_000_000 / TICKS)


def stamp_of(message: Any) -> int:
    """ROS time of a message [ns]."""
    return int(message.header.stamp.sec) * 1_000_000_000 + int(message.header.stamp.nanosec)


def _remove_uncertain(runs: list[RecordedRun], before: Change, after: Change) -> None:
    """Remove intervals that may depend on changes missing between two others."""
    for run in runs:
        if run.origin.begins < after.stamp:
            run.intervals = Intervals(i for i in run.intervals if i.stamp <= before.stamp)
