"""Follows vibration: amplitudes of patterns of lines in each hunting period."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..checks.sample_check import VibrationCheck
from ..estimate import Event
from ..input_error import InputError
from ..sensors import Sensors
from ..teeth.baseline_file import VibrationBaseline
from ..train import FollowedTrain
from ..turning import Turning
from .growth import CELL, WINDOWS, JudgedPeriod, LearnedBaseline, VibrationGrowth
from .hunting_samples import HuntingPeriod, HuntingSamples, SampleCounters
from .lines import STRETCH, PatternAmplitudes
from .patterns import HARMONICS

Array = NDArray[np.float64]

PRESENT = 0.99  # share of the samples of a hunting period, below which it is not used
STEADY = 0.02  # relative standard deviation of the speed, above which the period is not used
LOADED = 0.05  # that of the torque, in the window of the amplitudes
DOUBTFUL = 0.05  # share of the hunting periods that are not judged, above which there is a remark
RESOLVED = 0.45  # share of the sample rate up to which a line is no alias of another


@dataclass
class VibrationCounters(SampleCounters):
    """Numbers of samples and hunting periods that were used, or not used, by reason."""

    periods: int = 0
    """Hunting periods with all samples, at a steady speed under load."""
    dropped_periods: int = 0
    """Hunting periods with missing samples, with a varying speed or torque, or with too little
    torque."""
    constant_periods: int = 0
    """Of `periods`, those in which a channel does not change, which is neither judged nor
    learned."""
    unscaled_periods: int = 0
    """Of `periods`, those whose mesh orders are not where the measured speed places them; they
    are neither judged nor learned."""
    compared_periods: int = 0
    """Of `periods`, those in which a growth would have been reported."""


class VibrationFollower:
    """Learns the amplitudes of the healthy gearbox, and reports which have grown."""

    def __init__(
        self, train: FollowedTrain, names: tuple[str, ...], period: float, sensors: Sensors
    ) -> None:
        self.names, self.period, self.counters = names, period, VibrationCounters()
        self._train, self._amplitudes = train, PatternAmplitudes(train, sensors.rolling)
        self._samples = HuntingSamples(train, period, self.counters)
        self._growth = VibrationGrowth(names, self._amplitudes.patterns, sensors.learning)
        self._constant: set[str] = set()  # channels
        self._check = VibrationCheck(names)
        self._highest = math.inf  # mesh order that the samples resolve, in the last hunting period

    @property
    def events(self) -> list[Event]:
        """Patterns that have grown."""
        return self._growth.events

    @property
    def judged(self) -> bool:
        """Whether a growth in any channel would have been reported."""
        return self.counters.compared_periods > 0 and not self._often(
            self.counters.constant_periods
        )

    def _often(self, periods: int) -> bool:
        """Whether so many hunting periods are a remark."""
        complete = self.counters.periods + self.counters.dropped_periods
        return periods > DOUBTFUL * complete

    @property
    def saved(self) -> VibrationBaseline | None:
        """Learned baselines; None if there are none."""
        cells = self._growth.complete
        if not cells:
            return None
        return VibrationBaseline(self.names, self.period, tuple(each.fields() for each in cells))

    def restore_own(self, saved: tuple[VibrationBaseline, ...]) -> None:
        """Use the saved baselines of this device, if there are any, instead of learning.

        Raises `InputError` if all are of other channels or of another period.
        """
        if not saved:
            return
        own = next((o for o in saved if (o.names, o.period) == (self.names, self.period)), None)
        patterns = len(self._amplitudes.patterns)
        if own is None:
            others = " and ".join(f"{', '.join(o.names)} at {1.0 / o.period:g} Hz" for o in saved)
            raise InputError(
                f"baseline: vibration of {others}: must be {', '.join(self.names)} at "
                f"{1.0 / self.period:g} Hz as measured"
            )
        if any(cell["found"].shape[2] != patterns for cell in own.cells):
            raise InputError("baseline: vibration: was learned with another planet_bearing")
        self._growth.use([LearnedBaseline.of_fields(fields) for fields in own.cells])

    def learn(self) -> None:
        """Forget baselines; events remain. The next hunting periods are learned."""
        self._growth.learn()

    def add(self, time: Array, values: Array) -> None:
        """Add samples in the units of the channels, (n, channels), with stamps [s], (n,)."""
        self._samples.add(time, self._check.judge(time, values))

    def judge(self, until: float, turning: Callable[[float, float], Turning]) -> None:
        """Judge the hunting periods that end by a time [s]; `turning` gives measured speeds."""
        for period in self._samples.periods(until, turning):
            point = self._operating_point(period)
            if point is None:
                self.counters.dropped_periods += 1
                continue
            self.counters.periods += 1
            self._judge(period, *point)

    def _operating_point(self, period: HuntingPeriod) -> tuple[float, float] | None:
        """Mean torque [N m] and speed [rad/s] of the input; None if the period is not usable.

        Means have the weights of the Hann window of the amplitudes, which follow from them.
        """
        inside = (period.course.time > period.begin) & (period.course.time < period.end)
        if np.count_nonzero(inside) < 2:  # whether the speed was steady is not known
            return None
        speeds, torques = period.course.speed[inside], period.course.torque[inside]
        passed = (period.course.time[inside] - period.begin) / (period.end - period.begin)
        weights = np.sin(math.pi * passed) ** 2
        torque, speed = (float(np.average(one, weights=weights)) for one in (torques, speeds))
        spread = math.sqrt(float(np.average((torques - torque) ** 2, weights=weights)))
        complete = len(period.time) >= PRESENT * (period.end - period.begin) / self.period
        gaps = np.diff(period.course.time[inside])
        steady = float(np.std(speeds)) <= STEADY * abs(speed) and gaps.max() < 3.0 * gaps.min()
        loaded = spread <= LOADED * abs(torque) and abs(torque) > CELL * self._train.torque
        usable = complete and steady and loaded
        return (torque, speed) if usable else None

    def _judge(self, period: HuntingPeriod, torque: float, speed: float) -> None:
        cell = self._growth.baseline_at(torque, speed) or self._new_baseline(torque, speed)
        self._highest = cell.highest
        constant = np.ptp(period.values, axis=0) == 0.0
        if constant.any():
            self.counters.constant_periods += 1
            self._constant |= {self.names[channel] for channel in np.flatnonzero(constant)}
        if constant.all():
            return
        angle = period.course.angle(period.time)
        found = self._amplitudes.of(angle, period.values, cell.highest)
        if found is None:
            self.counters.unscaled_periods += 1
            return
        found[:, constant] = np.nan
        amplitudes, floor = found / np.where(self._amplitudes.over_torque, abs(torque), 1.0)
        judged = JudgedPeriod(period.begin, amplitudes, floor, torque, speed)
        self.counters.compared_periods += self._growth.add(judged, cell, period.end)

    def _new_baseline(self, torque: float, speed: float) -> LearnedBaseline:
        mesh = abs(float(self._train.cycles) * speed) * (1.0 + CELL) / (2.0 * math.pi)  # [Hz]
        return LearnedBaseline(torque, speed, RESOLVED / (self.period * mesh))

    def remarks(self) -> Iterator[str]:
        """Reasons why the results are less certain, or why there are none, one line each."""
        yield from self._check.remarks()
        yield from self._learning_remarks()
        counted = self.counters
        complete = counted.periods + counted.dropped_periods
        if counted.dropped_periods > counted.periods:
            yield (
                f"vibration: {counted.dropped_periods} of {complete} hunting periods are "
                "not used: samples are missing, speed or torque changes, or the torque is too low"
            )
        if self._often(counted.constant_periods):
            yield (
                f"vibration: in {counted.constant_periods} of {complete} hunting periods a channel "
                f"is constant: {', '.join(sorted(self._constant))}, and not judged; check the "
                "sensor, or leave out its column"
            )
        if self._often(counted.unscaled_periods):
            yield (
                f"vibration: {counted.unscaled_periods} of {complete} hunting periods are "
                "not judged: the mesh frequency is not where the measured speed places it, to "
                f"within {100.0 * STRETCH:g} %; check the gain of the speed sensor, the times of "
                "the samples, and whether the sensor shows the mesh at all"
            )
        for pattern in self._amplitudes.patterns:
            if pattern.causes and not pattern.lines:
                yield (
                    f"vibration: {pattern.name}: not judged, as teeth may have lines at their "
                    "orders, to within the resolution of a hunting period"
                )
        if self._highest < HARMONICS + 1:
            yield (
                f"vibration: {1.0 / self.period:.4g} samples per second show lines up to "
                f"{self._highest:.2g} times the mesh frequency only"
            )

    def _learning_remarks(self) -> Iterator[str]:
        """Reasons why there is no hunting period yet that was compared with a baseline."""
        growth = self._growth
        if not self.counters.periods + self.counters.dropped_periods:
            yield self._samples.why_none()
        elif growth.learned < growth.learning:
            yield (
                f"vibration: {growth.learned} of {growth.learning} hunting periods of a "
                "baseline are learned"
            )
        elif growth.recent and not self.counters.compared_periods:
            yield (
                f"vibration: {growth.recent} hunting periods after those of the baseline: must "
                f"be at least {WINDOWS[0]}"
            )
