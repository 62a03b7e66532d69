"""Estimates and steps of the torque balances of gearboxes of one type.

Two filters process the same readings: one whose parameters decay to their priors gives the
intervals, and one whose parameters change slowly gives the innovations that show steps.
"""

from __future__ import annotations

from typing import NamedTuple

from ...scene import Scene
from ..loss_map import loss_map
from ..sensors import Sensors
from ..train import followed_train
from .balances import Balances, InnovationArrays, Measured
from .cusum import LIMIT, TERM, Cusum, Steps
from .filter import Array, BalanceFilter, Mask, alarm_memory, interval_memory

DIFFERENCE = 0.3  # error of an acceleration from two speeds: it is that of half a period earlier


class Found(NamedTuple):
    """What the readings of one time show."""

    innovations: InnovationArrays
    """Of the filters for intervals, (n,) each."""
    balances: Balances
    """Balances with the parameters of the filters for alarms, (n,) each."""
    steps: Steps
    """Steps that are detected now."""


class Monitor:
    """Filters and sums of n gearboxes of one type, read every `period` [s]."""

    def __init__(
        self,
        scene: Scene,
        sensors: Sensors,
        period: float,
        count: int = 1,
        limit: float = LIMIT,
        term: float = TERM,
    ) -> None:
        self.train, self.losses, self.period = followed_train(scene), loss_map(scene), period
        self.intervals, self.alarms = (
            BalanceFilter(self.train, self.losses, sensors, memory, count)
            for memory in (interval_memory(), alarm_memory(self.train))
        )
        self.cusum = Cusum(count, limit, term)

    def add(self, read: Measured) -> Found:
        """Add the readings of one time; return innovations, balances and steps."""
        innovations, _ = self.intervals.update(read)
        (value, sd, _), balances = self.alarms.update(read)
        steps = self.cusum.add(read.time, value, sd, balances.loss, self.period)
        return Found(innovations, balances, steps)

    def reopen(self, which: Mask, sd: Array) -> None:
        """Adapt the filters of some gearboxes to a step, see `BalanceFilter.reopen`."""
        self.alarms.restart(which)
        for filters in (self.intervals, self.alarms):
            filters.reopen(which, sd)

    def widen(self, which: Mask, noise: Array, time: float) -> None:
        """Start some gearboxes from their priors with another noise, see `BalanceFilter.widen`."""
        for filters in (self.intervals, self.alarms):
            filters.widen(which, noise)
        self.cusum.restart(which, time, forget=True)
