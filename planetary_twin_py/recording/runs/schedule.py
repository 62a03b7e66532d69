"""What a recording tells of its runs: where they came from, and all that was changed on the way."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

from ...printable import one_line
from ...scene import TUNABLES
from ...twin import TICKS
from ..container.records import RecordingError, files_of
from ..ros2.decode import Decoder, MessageError
from ..ros2.repeats import Repeats, unrepeated
from ..ros2.topics import ORIGIN, POINT, STATE
from ..ros2.typestore import is_recorded
from .origin import Origin, read_origin

# With which is simulated what was measured, and so has neither: those of `planetary-twin simulate`.
TOLERANCE = 1e-4
SAMPLE_RATE = 50_000.0  # [Hz]
_LONGEST = 300  # characters of a remark


class Interval(NamedTuple):
    """A published interval, as its GearboxState tells it."""

    number: int  # of its message
    stamp: int  # [ns]
    begin: int  # [ticks] of simulated time
    end: int
    tolerance: float
    sample_rate: float  # [Hz]
    recorded: bool = True  # else its message is missing, and known from those around it


class Change(NamedTuple):
    """An operating point, and the simulated instant [s] from which it holds."""

    number: int  # of its message
    stamp: int  # [ns]
    time: float
    values: dict[str, float]


@dataclass
class Run:
    """From a start at time zero to the last interval before the next start."""

    origin: Origin
    intervals: list[Interval] = field(default_factory=list)
    changes: list[Change] = field(default_factory=list)


def read_runs(path: Path, namespace: str, remarks: list[str]) -> list[Run]:
    """The runs of the gearbox in `namespace`; what keeps some from being complete, in `remarks`.

    Raises:
        RecordingError: no run is recorded from its start.
    """
    told = _Told(remarks)
    take: dict[str, Callable[[Any], None]] = {
        ORIGIN: told.origin,
        POINT: told.change,
        STATE: told.interval,
    }
    for name, message in messages_of(path, namespace, tuple(take), remarks):
        take[name](message)
    return told.runs(path, remarks)


def without_gaps(run: Run, remarks: list[str]) -> list[Interval]:
    """Intervals of a run with those between whose messages are missing, as far as they are known.

    These are taken to be like the next: `remarks` says where that cannot be, and the rest is lost.
    """
    whole: list[Interval] = []
    number, reached, stamp = run.intervals[0].number - 1, 0, run.origin.begins
    for interval in run.intervals:
        length, missing = interval.end - interval.begin, interval.number - number - 1
        if missing * length != interval.begin - reached:
            remarks.append(
                f"{missing} messages of {STATE} are missing before {reached / TICKS:g} s, and what "
                "they told is not known: what follows cannot be simulated again"
            )
            break
        for n in range(1, missing + 1):
            end = reached + n * length
            between = stamp + (interval.stamp - stamp) * n // (missing + 1)
            whole.append(Interval(number + n, between, end - length, end, *interval[4:6], False))
        whole.append(interval)
        number, reached, stamp = interval.number, interval.end, interval.stamp
    return whole


def messages_of(
    path: Path, namespace: str, names: tuple[str, ...], remarks: list[str]
) -> Iterator[tuple[str, Any]]:
    """Messages of these topics in file order, each with the name of its topic."""
    wanted = {f"{namespace}/{name}": name for name in names}
    repeats = Repeats()
    for file in files_of(path):
        decoder = Decoder(file, wanted.__contains__)
        for record in unrepeated(file, remarks, repeats):
            try:
                found = decoder.read(record)
            except MessageError as reason:
                if not reason.topic.endswith(f"/{ORIGIN}"):
                    raise
                remarks.append(f"{reason}; it is left out")  # other runs may have theirs
                continue
            if found:
                yield wanted[found[0]], found[1]


class _Told:
    """All that was told, before it is sorted into runs."""

    def __init__(self, remarks: list[str]) -> None:
        self._remarks = remarks
        self._origins: dict[int, Origin] = {}
        self._changes: list[Change] = []
        self._intervals: list[Interval] = []

    def origin(self, message: Any) -> None:
        try:
            origin = read_origin(message.data)
        except RecordingError as reason:  # other runs may have theirs
            self._remarks.append(one_line(f"a message of {ORIGIN} is left out: {reason}", _LONGEST))
            return
        self._origins[origin.begins] = origin

    def change(self, message: Any) -> None:
        # What was no parameter of the version that recorded stayed as its scene has it.
        values = {name: getattr(message, name) for name in TUNABLES if is_recorded(message, name)}
        change = Change(message.sequence, stamp_of(message), message.simulated_time, values)
        self._changes.append(change)

    def interval(self, message: Any) -> None:
        for name in ("tolerance", "sample_rate"):
            if not is_recorded(message, name):
                raise RecordingError(
                    f"{STATE} has no field {name} in this recording: nothing of it can be "
                    "simulated again"
                )
        end = round(message.simulated_time * TICKS)
        self._intervals.append(
            Interval(
                message.sequence,
                stamp_of(message),
                end - round(message.interval * TICKS),
                end,
                _or(message.tolerance, TOLERANCE),
                _or(message.sample_rate, SAMPLE_RATE),
            )
        )

    def runs(self, path: Path, remarks: list[str]) -> list[Run]:
        runs, skipped = self._started()
        if skipped:
            remarks.append(f"{skipped} intervals of a run whose start or origin is not recorded")
        self._share_changes(runs, remarks)
        runs = [run for run in runs if run.intervals]
        if not runs:
            raise RecordingError(
                f"{path}: holds no run from its start with its origin ({ORIGIN}) and its changes, "
                "so nothing can be simulated again; what begins later, by ~/start or ~/snapshot, "
                "holds none"
            )
        return runs

    def _started(self) -> tuple[list[Run], int]:
        """Runs that are told from their start, and the number of intervals of others."""
        runs: list[Run] = []
        begins = sorted(self._origins)
        skipped, before, run = 0, 0, None
        for interval in self._intervals:
            if interval.begin == 0:  # the newest origin since the interval before
                place = bisect_right(begins, interval.stamp)
                known = place and begins[place - 1] >= before
                run = Run(self._origins[begins[place - 1]]) if known else None
                runs += [run] if run else []
            if run is None:
                skipped += 1
            else:
                run.intervals.append(interval)
            before = interval.stamp
        return runs, skipped

    def _share_changes(self, runs: list[Run], remarks: list[str]) -> None:
        """Give each run its changes: stamps never go back, so they tell which is whose."""
        begins = [run.origin.begins for run in runs]
        for change in self._changes:
            if place := bisect_right(begins, change.stamp):
                runs[place - 1].changes.append(change)
        for before, after in pairwise(self._changes):
            if after.number != before.number + 1:
                remarks.append(
                    f"{after.number - before.number - 1} messages of {POINT} are missing: "
                    f"from {before.time:g} s on, that run cannot be simulated again"
                )
                _cut(runs, before, after)


def _or(value: float, default: float) -> float:
    return default if math.isnan(value) else value


def nanoseconds(ticks: int) -> int:
    """A time of the clock's ticks in [ns]."""
    return round(ticks * 1_000_000_000 / TICKS)


def stamp_of(message: Any) -> int:
    """ROS time of a message [ns]."""
    return int(message.header.stamp.sec) * 1_000_000_000 + int(message.header.stamp.nanosec)


def _cut(runs: list[Run], before: Change, after: Change) -> None:
    """Forget what may have followed from changes that are missing between two others."""
    for run in runs:
        if run.origin.begins < after.stamp:
            run.intervals = [kept for kept in run.intervals if kept.stamp <= before.stamp]
