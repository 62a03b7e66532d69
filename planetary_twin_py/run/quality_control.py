"""Quality control of a live twin: selects tolerance and sample rate by the cost of its windows.

It has no clock: the caller measures the computing time of each window.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from .tolerance import LIVE_TOLERANCE

# The error of a step is of third order in its length at least (Rosenbrock: fourth order).
DEARER = (10.0 / 3.0) ** (1.0 / 3.0)  # largest cost ratio of successive tolerances
HALVINGS = 3  # of the sample rate, at most
LOWEST_SAMPLE_RATE = 1e3  # [Hz] after halving
AVERAGING = 0.5  # [s] over which the cost is averaged
FEWEST = 4  # windows in an average
CALM = 1.0  # [s] for which the load must be low before a better setting is tried
LONGEST_CALM = 64.0  # [s]
COMFORTABLE = 0.8  # load at which a higher sample rate is tried, whose cost is not known


class Setting(NamedTuple):
    """Tolerance and sample rate of a twin."""

    tolerance: float
    sample_rate: float  # [Hz] of the waveform


def settings_of(tolerances: Sequence[float], sample_rate: float) -> list[Setting]:
    """Settings in ascending order of quality.

    Args:
        tolerances: the loosest first.
        sample_rate: full rate of the waveform [Hz].

    Returns:
        Halved rates at the loosest tolerance, then all tolerances at the full rate.
    """
    halves = [sample_rate / 2**n for n in range(HALVINGS, 0, -1)]
    thinned = [Setting(tolerances[0], rate) for rate in halves if rate >= LOWEST_SAMPLE_RATE]
    return thinned + [Setting(tolerance, sample_rate) for tolerance in tolerances]


class QualityControl:
    """Selects a setting by the load, which is computing time/available time of windows.

    Two successive windows with a load above 1, or a mean over half a second above the limit, reduce
    the quality at once, by as many steps as necessary. The limit is `share` of the processor time
    for tolerances and 1 for the sample rate, which is reduced only if the twin would be late
    otherwise.

    A mean below the limit must last before a better setting is tried: several steps at once if none
    of them can exceed the limit, then single steps: a tolerance if the twin cannot be late, a
    higher sample rate if the load is comfortable. If a setting proves too expensive, the next
    attempt waits twice as long, and the cost of a tolerance is stored, to avoid oscillation.

    A repeated window does not show the cost of a tolerance, so such windows improve the quality up
    to the initial setting only. Without this, a short overload, such as the start of other
    processes, would leave the tolerance loose for the rest of the run.

    Args:
        ladder: from `settings_of`.
        share: largest mean load.
        period: available time for a window [s].
        begin: initial setting; if the ladder lacks it, the next better one.
    """

    def __init__(
        self, ladder: Sequence[Setting], share: float, period: float, begin: Setting
    ) -> None:
        self._ladder = ladder
        self._share = share
        self._period = period
        self._rung = sum(_rank(setting) < _rank(begin) for setting in ladder[:-1])
        self._first = self._rung
        self._full = sum(setting.sample_rate < ladder[-1].sample_rate for setting in ladder)
        self._windows = max(math.ceil(AVERAGING / period - 1e-9), FEWEST)
        self._loads: list[float] = []
        self._last = 0.0
        self._repeated = False
        self._climbed_at = math.nan  # mean load at which the present setting was tried
        self.load = math.nan
        """Load at the last decision."""
        self.relearn()

    @property
    def automatic(self) -> bool:
        """Whether there are several tolerances."""
        return self._full < len(self._ladder) - 1

    @property
    def setting(self) -> Setting:
        """Setting for the next window."""
        return self._ladder[self._rung]

    @property
    def full_sample_rate(self) -> float:
        """Full rate of the waveform [Hz]."""
        return self._ladder[-1].sample_rate

    def without_deadline(self) -> QualityControl:
        """Quality control for windows that may take any time.

        Returns:
            One with a single setting, so that results do not depend on the load of the computer:
            the tolerance of this one, or LIVE_TOLERANCE if it is selected automatically, and the
            full sample rate.
        """
        tolerance = LIVE_TOLERANCE if self.automatic else self._ladder[-1].tolerance
        only = Setting(tolerance, self.full_sample_rate)
        return QualityControl([only], self._share, self._period, only)

    def relearn(self) -> None:
        """Reset what was learned about costs, after a change of the operating point."""
        self._calm_needed = CALM
        self._calm = 0.0
        self._dearer = [1.0] * len(self._ladder)  # cost ratio to the next worse setting

    def observe(self, cost: float, work: float, repeated: bool = False) -> None:
        """Update with a window.

        A window that is in time counts with its processor time, because a delay by other processes
        does not depend on the setting. A late window counts with its wall time.

        Args:
            cost: wall time of the window [s].
            work: processor time of the window [s].
            repeated: whether steady running was repeated, not computed; the cost then does not
                depend on the tolerance.
        """
        load = (work if cost <= self._period else cost) / self._period
        if repeated != self._repeated:
            self._repeated = repeated
            self._restart_average()
        late, self._last = min(load, self._last), load
        self._loads.append(load)
        if late > 1.0:
            self.load = late
            self._descend(late)
        elif len(self._loads) >= self._windows:
            self.load = sum(self._loads) / len(self._loads)
            self._decide(self.load)

    def _decide(self, mean: float) -> None:
        """Decide by a mean load."""
        if mean > self._grant(self._rung):
            self._descend(mean)
            return
        goal = self._goal(mean)
        self._calm = self._calm + len(self._loads) * self._period if goal > self._rung else 0.0
        self._loads.clear()
        if self._calm >= self._calm_needed:
            self._move(goal)
            self._climbed_at = mean

    def _goal(self, mean: float) -> int:
        """Index of the setting to try."""
        top = max(self._full, self._first) if self._repeated else len(self._ladder) - 1
        goal, most = self._rung, mean
        while goal < top and (most := most * self._steepest(goal + 1)) <= self._limit(goal + 1):
            goal += 1
        return self._rung + 1 if goal == self._rung < top and self._may_improve(mean) else goal

    def _may_improve(self, mean: float) -> bool:
        """Whether the next better setting may be tried."""
        above = self._rung + 1
        if above <= self._full:
            return mean <= COMFORTABLE
        return mean * DEARER < 1.0 and mean * self._dearer[above] <= self._share

    def _descend(self, load: float) -> None:
        if self._climbed_at < load:
            self._calm_needed = min(2.0 * self._calm_needed, LONGEST_CALM)
            self._dearer[self._rung] = min(load / self._climbed_at, self._steepest(self._rung))
        rung = self._rung
        while rung and load > self._grant(rung):
            load /= self._steepest(rung)
            rung -= 1
        self._move(rung)

    def _grant(self, rung: int) -> float:
        """Load above which a setting is left for a worse one."""
        return 1.0 if self._repeated else self._limit(rung)

    def _limit(self, rung: int) -> float:
        """Largest load at which a setting is tried."""
        return self._share if rung > self._full else 1.0

    def _steepest(self, rung: int) -> float:
        """Largest cost ratio of a setting to the next worse one."""
        if rung <= self._full:
            return 2.0
        return 1.0 if self._repeated else DEARER

    def _move(self, rung: int) -> None:
        self._rung = rung
        self._climbed_at = math.nan
        self._restart_average()

    def _restart_average(self) -> None:
        """Start a new average."""
        self._last = self._calm = 0.0
        self._loads.clear()


def _rank(setting: Setting) -> tuple[float, float]:
    """Sort key: a better setting is greater."""
    return setting.sample_rate, -setting.tolerance
