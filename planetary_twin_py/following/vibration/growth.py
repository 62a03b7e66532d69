"""Growth of the amplitudes of vibration patterns, against learned baselines.

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
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit

from ...text.intervals import plus_minus
from ..balance.cusum import YEAR
from ..estimate import CONFIDENT, Estimate, Event, estimated, not_identifiable
from ..teeth.onset import onset_of
from .patterns import Pattern

Array = NDArray[np.float64]

CELL = 0.1  # relative distance of torque and speed within which a baseline applies
OVER_TORQUE = 1.0  # largest exponent over the torque of an amplitude divided by the torque
OVER_SPEED = 4.0  # largest exponent over the speed: 2 of an acceleration, the rest of resonances
WINDOWS = 4, 16  # hunting periods that are judged together
UNKNOWN = "; size of the fault: NOT IDENTIFIABLE, as the path to the sensor is unknown"


class JudgedPeriod(NamedTuple):
    """Amplitudes of a hunting period."""

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
class LearnedBaseline:
    """Amplitudes divided by the torque, at one torque and speed."""

    torque: float
    """Mean torque at the input of the first period [N m]."""
    speed: float
    """Mean speed of the input in it [rad/s]."""
    highest: float
    """Mesh order below which the sample rate resolves a line."""
    learned: list[JudgedPeriod] = field(default_factory=list)
    """Hunting periods without a fault."""

    def fields(self) -> dict[str, NDArray[Any]]:
        """Values from which `of_fields` restores the baseline."""
        values = {name: np.array(getattr(self, name)) for name in ("torque", "speed", "highest")}
        return values | {
            name: np.array([getattr(period, name) for period in self.learned])
            for name in JudgedPeriod._fields
            if name not in values
        } | {
            f"each_{name}": np.array([getattr(period, name) for period in self.learned])
            for name in ("torque", "speed")
        }  # fmt: skip

    @classmethod
    def of_fields(cls, fields: Mapping[str, NDArray[Any]]) -> LearnedBaseline:
        """A baseline of the values of `fields`."""
        columns = [fields[name] for name in ("begin", "found", "floor", "each_torque",
                                             "each_speed")]  # fmt: skip
        learned = [JudgedPeriod(*row) for row in zip(*columns, strict=True)]
        torque, speed, highest = (float(fields[name]) for name in ("torque", "speed", "highest"))
        return cls(torque, speed, highest, learned)

    def covers(self, torque: float, speed: float) -> bool:
        """Whether the baseline applies at a torque [N m] and a speed [rad/s] of the input."""
        similar_torque = abs(torque - self.torque) <= CELL * abs(self.torque)
        return similar_torque and abs(speed - self.speed) <= CELL * abs(self.speed)


class VibrationGrowth:
    """Learns the amplitudes of the healthy gearbox, and reports which have grown.

    `learning` is the number of hunting periods of a baseline, for each torque and speed.
    """

    def __init__(self, names: tuple[str, ...], patterns: Sequence[Pattern], learning: int) -> None:
        self._names, self._patterns, self._usual_learning = names, patterns, learning
        self._alarming = np.array([bool(pattern.causes) for pattern in patterns])
        self._tests = len(names) * int(self._alarming.sum()) * len(WINDOWS)
        self.events: list[Event] = []
        """Patterns that have grown."""
        self.learn()

    def learn(self) -> None:
        """Forget baselines; events remain. The next hunting periods are learned."""
        self.learning = self._usual_learning
        """Number of hunting periods of a baseline."""
        self._baselines: list[LearnedBaseline] = []
        self._recent: deque[JudgedPeriod] = deque(maxlen=WINDOWS[-1])
        self._cell: LearnedBaseline | None = None
        self._reported: dict[tuple[int, int], tuple[int, LearnedBaseline]] = {}
        """Index of the event, and the baseline that showed it, by channel and pattern."""

    def use(self, baselines: Sequence[LearnedBaseline]) -> None:
        """Use saved baselines of the same channels and patterns instead of learning."""
        self.learn()
        self._baselines += baselines
        self.learning = min(len(baseline.learned) for baseline in self._baselines)

    @property
    def complete(self) -> list[LearnedBaseline]:
        """Baselines that are learned."""
        return [each for each in self._baselines if len(each.learned) >= self.learning]

    @property
    def learned(self) -> int:
        """Hunting periods of the baseline at the present operating point; `learning` at most."""
        return self.learning if self._cell is None else min(len(self._cell.learned), self.learning)

    @property
    def recent(self) -> int:
        """Hunting periods after those of the baseline that are judged together."""
        return len(self._recent)

    def baseline_at(self, torque: float, speed: float) -> LearnedBaseline | None:
        """The baseline at a torque [N m] and a speed [rad/s] of the input, if any."""
        return next((each for each in self._baselines if each.covers(torque, speed)), None)

    def add(self, period: JudgedPeriod, cell: LearnedBaseline, end: float) -> bool:
        """Learn a hunting period, or report what has grown.

        `cell` is from `baseline_at`, or new. Returns whether a growth would have been reported.
        """
        if cell is not self._cell:
            self._cell = cell
            self._recent.clear()
        if not cell.learned:
            self._baselines.append(cell)
        if len(cell.learned) < self.learning:
            cell.learned.append(period)
            return False
        self._recent.append(period)
        self._report_growth(cell, end)
        compared = [*cell.learned, *list(self._recent)[-WINDOWS[0] :]]
        known = np.isfinite([each.found for each in compared]).all(axis=0)
        return len(self._recent) >= WINDOWS[0] and bool(known.any())

    def _limit(self, duration: float) -> float:
        """Standardised growth that is reported: one false alarm in a year, or less.

        That is by chance, in all channels, patterns and windows of hunting periods of this duration
        [s]. The standard deviation is known from a few hunting periods only, so it is a quantile of
        Student's distribution. Windows overlap, so false alarms are rarer.
        """
        return -float(stdtrit(self.learning - 1, duration / (YEAR * self._tests)))

    def _report_growth(self, cell: LearnedBaseline, now: float) -> None:
        """Report amplitudes that have grown in any window."""
        limit = self._limit(now - self._recent[-1].begin)
        learned = np.array([period.found for period in cell.learned])
        mean, sd = learned.mean(axis=0), learned.std(axis=0, ddof=1)
        for key, (event_index, source) in self._reported.items():
            if source is cell:  # another baseline may have been learned after the growth
                self._update_growth(event_index, key, (mean, sd))
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
            noise = floor_ratio * sd * math.sqrt(1.0 / count + 1.0 / self.learning)
            for channel, pattern in np.argwhere((growth > limit * noise) & self._alarming).tolist():
                if (channel, pattern) in self._reported:
                    continue
                self._reported[channel, pattern] = len(self.events), cell
                name, _, causes = self._patterns[pattern]
                z = float(growth[channel, pattern] / noise[channel, pattern])
                size = not_identifiable("vibration_growth", math.nan, "", "the next hunting period")
                evidence = f"{self._names[channel]}: z = {z:.1f}, limit {limit:.1f}{UNKNOWN}"
                what = f"vibration grew: {name}"
                since = self._earliest_start((channel, pattern), mean, sd, now)
                self.events.append(Event(what, since, now, size, causes, evidence))

    def _earliest_start(self, key: tuple[int, int], mean: Array, sd: Array, now: float) -> float:
        """Earliest time at which a pattern may have grown [s]."""
        amounts = np.array([period.found[key] for period in self._recent]) - mean[key]
        amounts = np.where(np.isnan(amounts), 0.0, amounts)  # of a constant channel
        first = self._recent[onset_of(amounts, float(sd[key])).first].begin
        # A step later than half of a hunting period belongs to the next one.
        return first - 0.5 * (now - self._recent[-1].begin)

    def _update_growth(
        self, event_index: int, key: tuple[int, int], baseline: tuple[Array, Array]
    ) -> None:
        """Growth of a pattern in the hunting periods that began after it was found."""
        event, (channel, pattern) = self.events[event_index], key
        size = self._growth(event.found, key, baseline)
        if size is None:
            return
        texts = [f"{self._patterns[pattern].name} grew by {_percent(size)} %"]
        for indicator in np.flatnonzero(~self._alarming).tolist():
            change = self._growth(event.found, (channel, indicator), baseline)
            if change is not None and not change.low <= 0.0 <= change.high:
                texts.append(f"{self._patterns[indicator].name} by {_percent(change)} %")
        evidence = f"{self._names[channel]}: {', '.join(texts)}{UNKNOWN}"
        self.events[event_index] = replace(event, size=size, evidence=evidence)

    def _growth(
        self, begin: float, key: tuple[int, int], baseline: tuple[Array, Array]
    ) -> Estimate | None:
        """Relative growth in the recent hunting periods from a time on; None without any."""
        amplitudes = np.array(
            [period.found[key] for period in self._recent if period.begin >= begin]
        )
        amplitudes = amplitudes[np.isfinite(amplitudes)]  # without constant channels
        mean, sd = (float(statistic[key]) for statistic in baseline)
        if not len(amplitudes) or not mean > 0.0:
            return None
        scatter = max(sd, float(np.std(amplitudes)))
        growth_sd = math.sqrt(scatter**2 / len(amplitudes) + sd**2 / self.learning)
        growth = (float(amplitudes.mean()) - mean) / mean
        return estimated("vibration_growth", growth, growth_sd / mean, "")


def _percent(growth: Estimate) -> str:
    return plus_minus(100.0 * growth.value, 100.0 * CONFIDENT * growth.sd, "+")


def _explained_growth(recent: Sequence[JudgedPeriod], learned: Sequence[JudgedPeriod]) -> float:
    """Relative growth that torque and speed explain where they differ from those learned."""
    (torque, speed), (torques, speeds) = (
        np.mean([(period.torque, period.speed) for period in periods], axis=0)
        for periods in (recent, learned)
    )
    return float(OVER_TORQUE * abs(torque / torques - 1.0) + OVER_SPEED * abs(speed / speeds - 1.0))
