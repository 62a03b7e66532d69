"""Follows vibration: amplitudes of patterns of lines, against a learned baseline.

The transfer path from the teeth to a sensor on a housing is unknown. So amplitudes determine no
friction, no stiffness and no size of a fault, only that a pattern has grown, and of which gear.

Amplitudes grow with the torque and are divided by it. A growth is reported only beyond what the
remaining difference of torque and speed from those of the baseline explains. Where the speed
changes faster than it is measured, harmonics leak into their neighbourhood, so what has grown
beside the sidebands as well is subtracted.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr, stdtrit

from ..interval_text import plus_minus
from .baseline_file import VibrationBaseline
from .checks import InputError
from .estimate import CONFIDENT, Event, estimated, not_identifiable
from .onset import onset_of
from .tooth_search import ALARM
from .train import FollowedTrain
from .vibration_lines import HARMONICS, STRETCH, PatternAmplitudes

Array = NDArray[np.float64]

CELL = 0.1  # relative distance of torque and speed within which a baseline applies
OVER_TORQUE = 1.0  # largest exponent over the torque of an amplitude divided by the torque
OVER_SPEED = 4.0  # largest exponent over the speed: 2 of an acceleration, the rest of resonances
WINDOWS = 4, 16  # hunting periods that are judged together
PRESENT = 0.99  # share of the samples of a hunting period, below which it is not used
STEADY = 0.02  # relative standard deviation of the speed, above which the period is not used
DOUBTFUL = 0.05  # share of the hunting periods that are not judged, above which there is a remark
RESOLVED = 0.45  # share of the sample rate up to which a line is no alias of another
SLOWEST = 0.05  # share of the speed of the scene, below which the train counts as at rest
UNKNOWN = "; size of the fault: NOT IDENTIFIABLE, as the path to the sensor is unknown"


class Turning(NamedTuple):
    """Speed and torque over time."""

    time: Array
    """Middles of the bins [s], (n,)."""
    speed: Array
    """Speed of the input [rad/s], (n,)."""
    torque: Array
    """Torque of the input [N m], (n,)."""


class VibrationSamples(NamedTuple):
    """Samples of vibration in the order of their arrival."""

    time: Array
    """Stamps [s], (n,)."""
    values: Array
    """Samples in the units of the channels, (n, channels)."""
    names: tuple[str, ...]
    """Names of the channels."""
    period: float
    """Sample period [s]."""


@dataclass
class VibrationCounters:
    """Numbers of samples and hunting periods that were used, or not used, by reason."""

    used: int = 0
    """Samples that are used."""
    late: int = 0
    """Samples that arrived after their hunting period or too long before the readings of the speed,
    occur twice, or are not finite."""
    periods: int = 0
    """Hunting periods with all samples, at a steady speed under load."""
    dropped_periods: int = 0
    """Hunting periods with missing samples, with a varying speed, or with too little torque."""
    constant_periods: int = 0
    """Of these, periods in which a channel does not change; they are neither judged nor learned."""
    unscaled_periods: int = 0
    """Of these, periods whose first mesh order is not where the measured speed places it; they are
    neither judged nor learned."""
    compared_periods: int = 0
    """Of these, periods in which a growth would have been reported."""


class _Judged(NamedTuple):
    """A hunting period."""

    begin: float
    """[s]."""
    found: Array
    """Amplitudes over torque, (channels, patterns)."""
    floor: Array
    """Amplitudes over torque beside the sidebands, where no gear has lines, or NaN."""
    torque: float
    """Mean torque at the input [N m]."""
    speed: float
    """Mean speed of the input [rad/s]."""


@dataclass
class _Baseline:
    """Amplitudes divided by the torque, at one torque and speed."""

    torque: float
    speed: float
    highest: float
    """Mesh order below which the sample rate resolves a line."""
    learned: list[_Judged] = field(default_factory=list)

    def fields(self) -> dict[str, NDArray[Any]]:
        """Values from which `of_fields` restores the baseline."""
        values = {name: np.array(getattr(self, name)) for name in ("torque", "speed", "highest")}
        return values | {
            name: np.array([getattr(period, name) for period in self.learned])
            for name in _Judged._fields
            if name not in values
        } | {
            f"each_{name}": np.array([getattr(period, name) for period in self.learned])
            for name in ("torque", "speed")
        }  # fmt: skip

    @classmethod
    def of_fields(cls, fields: Mapping[str, NDArray[Any]]) -> _Baseline:
        """A baseline of the values of `fields`."""
        columns = [fields[name] for name in ("begin", "found", "floor", "each_torque",
                                             "each_speed")]  # fmt: skip
        learned = [_Judged(*row) for row in zip(*columns, strict=True)]
        torque, speed, highest = (float(fields[name]) for name in ("torque", "speed", "highest"))
        return cls(torque, speed, highest, learned)

    def covers(self, torque: float, speed: float) -> bool:
        similar_torque = abs(torque - self.torque) <= CELL * abs(self.torque)
        return similar_torque and abs(speed - self.speed) <= CELL * abs(self.speed)


class VibrationFollower:
    """Learns the amplitudes of the healthy gearbox, and reports which have grown.

    Args:
        train: gear train, which defines the mesh orders.
        names: names of the channels.
        period: sample period [s].
        learning: number of hunting periods of a baseline, for each torque and speed.
    """

    def __init__(
        self, train: FollowedTrain, names: tuple[str, ...], period: float, learning: int
    ) -> None:
        self.names, self.period, self.counters = names, period, VibrationCounters()
        self.events: list[Event] = []
        """Patterns that have grown."""
        self._train, self._usual_learning = train, learning
        self._period_angle = 2.0 * math.pi * train.hunting_cycles / abs(float(train.cycles))
        self._longest_period = self._period_angle / (SLOWEST * train.speed)  # [s]
        self._amplitudes = PatternAmplitudes(train)
        self._waiting: list[tuple[Array, Array]] = []
        self._most_samples = round(2.0 * self._longest_period / period)
        self._begin = math.nan  # start of the present hunting period [s]
        self._judged_until = math.nan  # time of the last call of `judge` [s]
        self._sampled = math.inf, -math.inf  # first and last sample [s]
        self._speed_from = math.nan  # first reading of the speed [s]
        self._constant: set[str] = set()  # channels
        self._highest = math.inf  # mesh order that the samples resolve, in the last hunting period
        self.learn()

    @property
    def saved(self) -> VibrationBaseline | None:
        """Learned baselines; None if there are none."""
        cells = [
            baseline for baseline in self._baselines if len(baseline.learned) >= self._learning
        ]
        if not cells:
            return None
        return VibrationBaseline(
            self.names, self.period, tuple(baseline.fields() for baseline in cells)
        )

    def restore(self, saved: VibrationBaseline) -> None:
        """Use saved baselines instead of learning.

        Args:
            saved: baselines of the same channels and sample period.

        Raises:
            InputError: they are of other channels or of another period.
        """
        if (saved.names, saved.period) != (self.names, self.period):
            raise InputError(
                f"baseline: vibration of {', '.join(saved.names)} at {1.0 / saved.period:g} Hz: "
                f"must be {', '.join(self.names)} at {1.0 / self.period:g} Hz as measured"
            )
        self.learn()
        self._baselines += [_Baseline.of_fields(fields) for fields in saved.cells]
        self._learning = min(len(baseline.learned) for baseline in self._baselines)

    def learn(self) -> None:
        """Forget baselines; events remain. The next hunting periods are learned."""
        self._learning = self._usual_learning
        self._baselines: list[_Baseline] = []
        self._recent: deque[_Judged] = deque(maxlen=WINDOWS[-1])
        self._cell: _Baseline | None = None
        self._reported: dict[tuple[int, int], tuple[int, _Baseline]] = {}
        """Index of the event, and the baseline that showed it, by channel and pattern."""

    @property
    def _limit(self) -> float:
        """Standardised growth that is reported.

        The standard deviation is known from a few hunting periods only, so this is the quantile of
        Student's distribution that has the probability of a normal z of ALARM.
        """
        return -float(stdtrit(self._learning - 1, ndtr(-ALARM)))

    def add(self, time: Array, values: Array) -> None:
        """Add samples in the order of their arrival.

        Args:
            time: stamps [s], (n,).
            values: samples in the units of the channels, (n, channels).
        """
        while self._waits_too_long():
            self.counters.late += len(self._waiting.pop(0)[0])
        usable = np.isfinite(time) & np.isfinite(values).all(axis=1) & ~(time < self._begin)
        self.counters.late += int(np.sum(~usable))
        self._waiting.append((time[usable], values[usable]))
        known = time[np.isfinite(time)]
        if len(known):
            first, last = self._sampled
            self._sampled = min(first, float(known.min())), max(last, float(known.max()))

    def _waits_too_long(self) -> bool:
        """Whether there are no readings, or their end is long before the newest samples."""
        if sum(len(part) for part, _ in self._waiting) <= self._most_samples:
            return False
        times = self._waiting[0][0]
        return not (len(times) and times.max() <= self._judged_until)

    def judge(self, until: float, turning: Callable[[float, float], Turning]) -> None:
        """Judge the hunting periods that end by a time.

        Args:
            until: time up to which the speed is known [s].
            turning: function of two times [s] that returns speed and torque between them.
        """
        if until == self._judged_until:
            return
        self._judged_until = until
        if math.isnan(self._speed_from):
            known = turning(-math.inf, until).time
            self._speed_from = float(known[0]) if len(known) else math.nan
        while self._waiting:
            if math.isnan(self._begin) and not self._start(turning(-math.inf, until)):
                return
            course = turning(self._begin, min(until, self._begin + self._longest_period))
            end = _end_of(course, self._period_angle, self._begin)
            if end is None:
                if until > self._begin + self._longest_period:  # the train is at rest
                    self._pop_samples(until)
                    self._begin = until
                return
            newest = max((float(time.max()) for time, _ in self._waiting if len(time)), default=0.0)
            if end > until or newest < end:
                return
            span, self._begin = (self._begin, end), end
            self._judge(span, *self._pop_samples(end), course)

    def _start(self, course: Turning) -> bool:
        """Start at the first sample whose speed is known; return whether there is one."""
        firsts = [float(time.min()) for time, _ in self._waiting if len(time)]
        if not (firsts and len(course.time)):
            return False
        self._begin = max(min(firsts), float(course.time[0]))
        self._pop_samples(self._begin)
        return True

    def _pop_samples(self, until: float) -> tuple[Array, Array]:
        """Remove and return the samples before a time, in order, without duplicates."""
        time = np.concatenate([part for part, _ in self._waiting])
        values = np.concatenate([part for _, part in self._waiting])
        order = np.argsort(time, kind="stable")
        time, values = time[order], values[order]
        distinct = np.diff(time, prepend=-np.inf) > 0.5 * self.period
        self.counters.late += int(np.sum(~distinct))
        time, values = time[distinct], values[distinct]
        ready = time < until
        self._waiting = [(time[~ready], values[~ready])] if not ready.all() else []
        self.counters.used += int(np.sum(ready))
        return time[ready], values[ready]

    def _judge(
        self, span: tuple[float, float], time: Array, values: Array, course: Turning
    ) -> None:
        inside = (course.time > span[0]) & (course.time < span[1])
        if np.count_nonzero(inside) < 2:  # whether the speed was steady is not known
            self.counters.dropped_periods += 1
            return
        speeds, torque = course.speed[inside], float(np.mean(course.torque[inside]))
        speed = float(np.mean(speeds))
        complete = len(time) >= PRESENT * (span[1] - span[0]) / self.period
        gaps = np.diff(course.time[inside])
        steady = float(np.std(speeds)) <= STEADY * abs(speed) and gaps.max() < 3.0 * gaps.min()
        if not (complete and steady and abs(torque) > CELL * self._train.torque):
            self.counters.dropped_periods += 1
            return
        self.counters.periods += 1
        cell = self._cell_at(torque, speed)
        self._highest = cell.highest
        if constant := {
            name
            for name, spread in zip(self.names, np.ptp(values, axis=0), strict=True)
            if not spread
        }:
            self.counters.constant_periods += 1
            self._constant |= constant
            return
        found = self._amplitudes.of(_angle(time, course), values, cell.highest)
        if found is None:
            self.counters.unscaled_periods += 1
            return
        amplitudes, floor = found / abs(torque)
        judged = _Judged(span[0], amplitudes, floor, torque, speed)
        if cell is not self._cell:
            self._cell = cell
            self._recent.clear()
        if not cell.learned:
            self._baselines.append(cell)
        if len(cell.learned) < self._learning:
            cell.learned.append(judged)
            return
        self._recent.append(judged)
        self._report_growth(cell, span[1])

    def _cell_at(self, torque: float, speed: float) -> _Baseline:
        """The baseline of an operating point, or a new one."""
        for baseline in self._baselines:
            if baseline.covers(torque, speed):
                return baseline
        mesh = abs(float(self._train.cycles) * speed) * (1.0 + CELL) / (2.0 * math.pi)  # [Hz]
        return _Baseline(torque, speed, RESOLVED / (self.period * mesh))

    def _report_growth(self, cell: _Baseline, now: float) -> None:
        """Report amplitudes that have grown in any window."""
        learned = np.array([period.found for period in cell.learned])
        mean, sd = learned.mean(axis=0), learned.std(axis=0, ddof=1)
        for key, (event_index, source) in self._reported.items():
            if source is cell:  # another baseline may have been learned after the growth
                self._update_growth(event_index, key, (mean, sd))
        if len(self._recent) >= WINDOWS[0] and np.isfinite(mean).any():
            self.counters.compared_periods += 1
        for count in WINDOWS:
            if count > len(self._recent):
                return
            recent = list(self._recent)[-count:]
            growth = np.mean([period.found for period in recent], axis=0) - mean
            growth -= _explained_growth(recent, cell.learned) * mean
            floor = np.nan_to_num(np.mean([period.floor for period in recent], axis=0))
            learned_floor = np.nan_to_num(
                np.mean([period.floor for period in cell.learned], axis=0)
            )
            growth -= np.maximum(floor - learned_floor, 0.0)
            floor_ratio = np.maximum(
                floor / np.where(learned_floor > 0.0, learned_floor, np.inf), 1.0
            )
            noise = floor_ratio * sd * math.sqrt(1.0 / count + 1.0 / self._learning)
            for channel, pattern in np.argwhere(growth > self._limit * noise).tolist():
                if (channel, pattern) in self._reported:
                    continue
                self._reported[channel, pattern] = len(self.events), cell
                name, _, causes = self._amplitudes.patterns[pattern]
                z = float(growth[channel, pattern] / noise[channel, pattern])
                size = not_identifiable("vibration_growth", math.nan, "", "the next hunting period")
                evidence = f"{self.names[channel]}: z = {z:.1f}{UNKNOWN}"
                what = f"vibration grew: {name}"
                since = self._earliest_start((channel, pattern), mean, sd, now)
                self.events.append(Event(what, since, now, size, causes, evidence))

    def _earliest_start(self, key: tuple[int, int], mean: Array, sd: Array, now: float) -> float:
        """Earliest time at which a pattern may have grown [s]."""
        amounts = np.array([period.found[key] for period in self._recent]) - mean[key]
        first = self._recent[onset_of(amounts, float(sd[key])).first].begin
        # A step later than half of a hunting period belongs to the next one.
        return first - 0.5 * (now - self._recent[-1].begin)

    def _update_growth(
        self, event_index: int, key: tuple[int, int], baseline: tuple[Array, Array]
    ) -> None:
        """Growth of a pattern in the hunting periods that began after it was found."""
        event = self.events[event_index]
        amplitudes = np.array(
            [period.found[key] for period in self._recent if period.begin >= event.found]
        )
        if not len(amplitudes):
            return
        mean, sd = (float(statistic[key]) for statistic in baseline)
        scatter = max(sd, float(np.std(amplitudes)))
        growth_sd = math.sqrt(scatter**2 / len(amplitudes) + sd**2 / self._learning)
        size = estimated(
            "vibration_growth", (float(amplitudes.mean()) - mean) / mean, growth_sd / mean, ""
        )
        growth = plus_minus(100.0 * size.value, 100.0 * CONFIDENT * size.sd, "+")
        evidence = f"{self.names[key[0]]}: amplitude {growth} %{UNKNOWN}"
        self.events[event_index] = replace(event, size=size, evidence=evidence)

    def remarks(self) -> Iterator[str]:
        """Reasons why the results are less certain, or why there are none, one line each."""
        yield from self._learning_remarks()
        counted = self.counters
        complete = counted.periods + counted.dropped_periods
        if counted.dropped_periods > counted.periods:
            yield (
                f"vibration: {counted.dropped_periods} of {complete} hunting periods are "
                "not used: samples are missing, the speed changes, or the torque is too low"
            )
        if counted.constant_periods > DOUBTFUL * complete:
            yield (
                f"vibration: {counted.constant_periods} of {complete} hunting periods are "
                f"not judged, because a channel is constant: {', '.join(sorted(self._constant))}; "
                "check the sensor, or leave out its column"
            )
        if counted.unscaled_periods > DOUBTFUL * complete:
            yield (
                f"vibration: {counted.unscaled_periods} of {complete} hunting periods are "
                "not judged: the mesh frequency is not where the measured speed places it, to "
                f"within {100.0 * STRETCH:g} %; check the gain of the speed sensor, the times of "
                "the samples, and whether the sensor shows the mesh at all"
            )
        if self._highest < HARMONICS + 1:
            yield (
                f"vibration: {1.0 / self.period:.4g} samples per second show lines up to "
                f"{self._highest:.2g} times the mesh frequency only"
            )

    def _learning_remarks(self) -> Iterator[str]:
        """Reasons why there is no hunting period yet that was compared with a baseline."""
        if not self.counters.periods + self.counters.dropped_periods:
            yield self._without_period()
        elif self._cell is not None and len(self._cell.learned) < self._learning:
            yield (
                f"vibration: {len(self._cell.learned)} of {self._learning} hunting periods of a "
                "baseline are learned"
            )
        elif self._recent and not self.counters.compared_periods:
            yield (
                f"vibration: {len(self._recent)} hunting periods after those of the baseline: must "
                f"be at least {WINDOWS[0]}"
            )

    def _without_period(self) -> str:
        """Why no hunting period is complete."""
        if math.isnan(self._speed_from):
            return "vibration: not judged without readings of the speed"
        (first, last), begin, end = self._sampled, self._speed_from, self._judged_until
        shared = min(last, end) - max(first, begin)
        spans = (
            f"vibration: not judged: samples from {first:.2f} to {last:.2f} s and readings of the "
            f"speed from {begin:.2f} to {end:.2f} s"
        )
        if shared <= 0.0:
            return f"{spans} do not overlap"
        usual = self._period_angle / self._train.speed
        return (
            f"{spans} overlap for {shared:.2f} s; a hunting period takes {usual:.2f} s at the "
            "speed of the scene"
        )


def _explained_growth(recent: Sequence[_Judged], learned: Sequence[_Judged]) -> float:
    """Relative growth that torque and speed explain where they differ from those learned."""
    (torque, speed), (torques, speeds) = (
        np.mean([(period.torque, period.speed) for period in periods], axis=0)
        for periods in (recent, learned)
    )
    return float(OVER_TORQUE * abs(torque / torques - 1.0) + OVER_SPEED * abs(speed / speeds - 1.0))


def _angle(time: Array, course: Turning) -> Array:
    """Angle of the input [rad] at each of the times [s]."""
    speed = np.interp(time, course.time, course.speed)
    return np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time))])


def _end_of(course: Turning, angle: float, begin: float) -> float | None:
    """Time at which the input has turned by an angle since `begin` [s]; None if it has not."""
    later = course.time > begin
    if not later.any():
        return None
    first = float(np.interp(begin, course.time, course.speed))
    time = np.concatenate([[begin], course.time[later]])
    speed = np.abs(np.concatenate([[first], course.speed[later]]))
    turned = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time))])
    if turned[-1] < angle:
        return None
    return float(np.interp(angle, turned, time))
