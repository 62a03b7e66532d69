"""Simulates recorded runs again, interval by interval."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections import OrderedDict, deque
from collections.abc import Iterable, Iterator, Mapping
from itertools import accumulate
from typing import Any, NamedTuple

from ...model.clock import TICKS
from ...run.twin import Twin
from ...run.window import Window
from ..ros2.sensor_message import SensorMessage
from ..ros2.topics import AXES_WAVEFORM, WAVEFORM
from .expected_damage import ExpectedDamage
from .expected_sensors import Expected, ExpectedSensors
from .intervals import Interval
from .schedule import Change, RecordedRun, stamp_of, without_gaps

KEPT = 1000  # intervals in memory


class Resimulation:
    """Recorded runs that are simulated again on demand."""

    def __init__(self, runs: list[RecordedRun], remarks: list[str]) -> None:
        self._runs = runs
        self._begins = [run.origin.begins for run in runs]
        self._stamps = [run.intervals.stamps for run in runs]
        self._first = [0, *accumulate(map(len, self._stamps))]  # interval of each run
        self._windows = _windows(runs, remarks)
        self._cache: OrderedDict[int, tuple[Interval, Window]] = OrderedDict()
        self._count = 0
        self._sensors = [ExpectedSensors(run.origin.scene) for run in runs]
        self._damage = [ExpectedDamage(run) for run in runs]
        self._of_damage: dict[tuple[str, int], dict[str, Any]] = {}  # by topic and stamp [ns]

    def of_sensor(self, topic: str, message: Any) -> Expected | None:
        """The message of a sensor, simulated again; None if that is not possible."""
        stamp, number = stamp_of(message), getattr(message, "sequence", None)
        run = bisect_right(self._begins, stamp) - 1
        if run < 0:
            return None
        expected, time = self._sensors[run], _time_of(self._runs[run], stamp)
        while not expected.reaches(topic, number, time) and self._advance():
            pass
        return expected.get(topic, number, time)

    def of_damage(self, topic: str, message: Any) -> Expected | None:
        """The message of damage, simulated again; None if that is not possible."""
        found = self.interval_of(topic, message)
        fields = self._of_damage.pop((topic, stamp_of(message)), None)
        if found is None or fields is None:
            return None
        return Expected(*found, SensorMessage(topic, found[1].end, fields))

    def interval_of(self, topic: str, message: Any) -> tuple[Interval, Window] | None:
        """The interval of a message, simulated again; None if that is not possible."""
        stamp = stamp_of(message)
        run = bisect_right(self._begins, stamp) - 1
        if run < 0:
            return None
        within = bisect_left(self._stamps[run], stamp)
        if within == len(self._stamps[run]):
            return None
        place = self._first[run] + within
        if topic in (WAVEFORM, AXES_WAVEFORM):  # stamped with its first sample
            for candidate in (place, place + 1):  # the stamp may be rounded to the interval before
                simulated = self._simulated(candidate)
                if simulated and _is_block_of(simulated[1], message):
                    return simulated
            return None
        return self._simulated(place) if self._stamps[run][within] == stamp else None

    def _simulated(self, place: int) -> tuple[Interval, Window] | None:
        while self._count <= place and self._advance():
            pass
        return self._cache.get(place)

    def _advance(self) -> bool:
        """Simulate the next interval, if there is one."""
        simulated = next(self._windows, None)
        if simulated is None:
            return False
        run, interval, window = simulated
        self._sensors[run].add(interval, window)
        for topic, fields in self._damage[run].of(window).items():
            self._of_damage[topic, interval.stamp] = fields
        if interval.recorded:
            self._cache[self._count] = interval, window
            self._count += 1
            if len(self._cache) > KEPT:
                self._cache.popitem(last=False)
        return True


def _is_block_of(window: Window, block: Any) -> bool:
    """Whether a block of samples belongs to a window."""
    time = window.waveform.time
    return len(time) > 0 and bool(time[0] == block.start_time)


class Step(NamedTuple):
    """A simulated interval, with the changes at its start."""

    interval: Interval
    changes: list[Change]
    severities: list[Mapping[str, float]]  # of the faults after each change
    window: Window


def steps(run: RecordedRun, intervals: Iterable[Interval] | None = None) -> Iterator[Step]:
    """Simulate the intervals of a run in order; or the given ones, from the same start."""
    first = run.intervals[0]
    twin = Twin(run.origin.scene, first.sample_rate, first.tolerance)
    if run.origin.damage is not None:
        twin.continue_cycles(run.origin.damage.turning)
    waiting = deque(run.changes)
    for interval in run.intervals if intervals is None else intervals:
        changes, severities = list[Change](), list[Mapping[str, float]]()
        while waiting and waiting[0].time <= twin.time:
            changes.append(waiting.popleft())
            twin.set(**changes[-1].values)
            severities.append(twin.severities)
        twin.set_tolerance(interval.tolerance)
        twin.set_sample_rate(interval.sample_rate)
        given = run.given.get(interval.stamp, {})
        window = twin.advance((interval.end - interval.begin) / TICKS, **given)
        yield Step(interval, changes, severities, window)


def _windows(runs: list[RecordedRun], remarks: list[str]) -> Iterator[tuple[int, Interval, Window]]:
    """Simulate every interval, run by run, with the number of the run."""
    for number, run in enumerate(runs):
        reached = None
        for interval, _, _, window in steps(run, without_gaps(run, remarks)):
            yield number, interval, window
            reached = interval
        if reached != run.intervals[-1]:
            return


def _time_of(run: RecordedRun, stamp: int) -> float:
    """Simulated time of a stamp [ns], about, as if it passed evenly in each interval [s]."""
    intervals = run.intervals
    place = min(bisect_left(intervals.stamps, stamp), len(intervals) - 1)
    interval = intervals[place]
    before = intervals[place - 1].stamp if place else run.origin.begins
    span = max(interval.stamp - before, 1)
    return (
        interval.end + (interval.end - interval.begin) * (stamp - interval.stamp) / span
    ) / TICKS
