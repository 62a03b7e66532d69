"""Averages readings over bins, and compares units, signs and stamps with the scene."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from ...scene import Scene
from ..arrival.bins import Array, Bin, Counters
from ..arrival.merging import Merge
from ..arrival.spacing import Spacing
from ..channels.all import TORQUES
from ..input_error import InputError
from ..loss_map import loss_map
from ..sensors import Sensors, torque_errors
from ..train import FollowedTrain, followed_train
from .checks import CHECKED, Checks
from .contradictions import Contradictions
from .load_remarks import LoadRemarks
from .power_check import PowerCheck
from .reading_check import ReadingCheck

PERIOD = 0.1  # [s] length of a bin; in longer bins innovations correlate when the load reverses


class CheckedBins:
    """Bins of readings that are checked as they close."""

    def __init__(self, scene: Scene, train: FollowedTrain, sensors: Sensors, period: float) -> None:
        noise, losses = [one.noise for one in torque_errors(sensors, train)], loss_map(scene)
        self._readings = ReadingCheck(train, sensors)
        self._left_out = self._readings.left_out[0]
        self._power = PowerCheck(train, losses, sensors, period, self._left_out)
        self._period = period
        self._merge = Merge(period, dict(zip(TORQUES, noise, strict=True)))
        together = max(round(CHECKED / period), 1)
        contradictions = Contradictions(train, losses, sensors, period)
        self._checks = Checks(contradictions, 1, (together, together))
        self._spacing = Spacing()
        self._load = LoadRemarks(scene.operating_point, train, period)

    @property
    def counters(self) -> Counters:
        """Numbers of readings that were not used, by reason."""
        return self._merge.counters

    def add(self, time: Array, columns: Mapping[str, Array], sender: str) -> Iterator[Bin]:
        """Add readings of a sender in the order of their arrival; return the complete bins.

        Stamps [s] and readings by channel in SI, (n,) each, are NaN where one is missing. Raises
        `InputError` where a channel has another unit, sign or shaft, see `checks`.
        """
        before = self._left_out.count
        kept = _judged(self._readings, time, columns, sender)
        self.counters.missing -= self._left_out.count - before  # as which the bins count them
        for time_bin in self._merge.add(time, kept, sender):
            yield from self._checked(time_bin)
        self.counters.implausible = self._left_out.count

    def finish(self) -> Iterator[Bin]:
        """Close the open bins, at the end of a recording."""
        self._readings.finish()
        for time_bin in self._merge.finish():
            yield from self._checked(time_bin)
        yield from self._judged(self._power.finish())
        self._checks.check()
        self._refuse()

    def remarks(self) -> Iterator[str]:
        """A line for readings that are left out, and for those unlike the scene."""
        yield from self._left_out.remarks()
        yield from self._readings.stops.remarks("not used")
        yield from self._checks.later.get(0, {}).values()
        yield from self._spacing.remarks(self._period)
        yield from self._load.remarks()

    def _checked(self, time_bin: Bin) -> Iterator[Bin]:
        agreed = self._checks.agreed()
        if not agreed:
            self._compare(time_bin)  # a wrong sign from the start is refused, not left out
        self._spacing.add((time_bin.number + 1) * self._period)
        self._load.add(time_bin.number * self._period, _row(time_bin))
        for judged in self._judged(self._power.add(time_bin)):
            if agreed:
                self._compare(judged)
            yield judged

    def _compare(self, time_bin: Bin) -> None:
        """Compare a bin with the scene."""
        self._checks.add((time_bin.number + 1) * self._period, _row(time_bin))
        self._refuse()

    def _refuse(self) -> None:
        """Refuse readings that contradict the scene from the start."""
        if 0 in self._checks.refused:
            raise InputError(self._checks.refused[0])

    def _judged(self, bins: Iterator[Bin]) -> Iterator[Bin]:
        """Bins after the check of the power, whose readings that are left out are not used."""
        before = self._left_out.count
        for time_bin in bins:
            self.counters.used -= self._left_out.count - before
            before = self.counters.implausible = self._left_out.count
            yield time_bin


def _row(time_bin: Bin) -> dict[str, Array]:
    """Means of a bin as a row of one gearbox."""
    return {name: np.array([mean.value]) for name, mean in time_bin.means.items()}


def _judged(
    check: ReadingCheck, time: Array, columns: Mapping[str, Array], sender: str
) -> dict[str, Array]:
    """Readings of one gearbox without those that are left out, (n,) each."""
    rows = {name: np.asarray(values, dtype=float)[:, None] for name, values in columns.items()}
    kept = check.judge(np.asarray(time, dtype=float), rows, sender)
    return {name: values[:, 0] for name, values in kept.items()}


class CheckedTable(NamedTuple):
    """Readings of a table that have been checked."""

    columns: dict[str, Array]
    """Readings in SI by channel, (n,) each; NaN where one is missing or left out."""
    remarks: tuple[str, ...]
    """A line for readings that are left out, units that may be wrong, and dead torques."""


def checked_table(
    scene: Scene, sensors: Sensors, time: Array, columns: Mapping[str, Array]
) -> CheckedTable:
    """Check all readings of a table, with stamps in order, as `CheckedBins` does."""
    train = followed_train(scene)
    bins = CheckedBins(scene, train, sensors, PERIOD)
    judged = [*bins.add(time, columns, "table"), *bins.finish()]
    check = ReadingCheck(train, sensors)
    kept = _judged(check, time, columns, "table")
    for name, rows in check.stopped:
        kept[name][rows - 1] = np.nan
    slots = np.floor(np.where(np.isfinite(time), time, -1.0) / PERIOD + 1e-9).astype(np.int64)
    for name in TORQUES:
        sound = [one.number for one in judged if name in one.means]
        if name in kept:
            kept[name][~np.isin(slots, sound)] = np.nan
    return CheckedTable(kept, tuple(bins.remarks()))
