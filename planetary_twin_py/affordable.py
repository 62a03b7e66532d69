"""The best setting a live twin can afford, from what its windows cost.

Pure arithmetic without a clock: whoever runs the twin measures, and feeds what it has measured.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

# The error of a step goes with the cube of its length at least (Rosenbrock's: the fourth power).
DEARER = (10.0 / 3.0) ** (1.0 / 3.0)  # what a tolerance may cost over the next looser one, at most
HALVINGS = 3  # of the waveform's rate, at most
LOWEST_SAMPLE_RATE = 1e3  # [Hz] that halving leaves
STRETCH = 0.5  # [s] over which a mean cost is taken
FEWEST = 4  # windows for that
PATIENCE = 1.0  # [s] a cost must have allowed for climbing
LONGEST_PATIENCE = 64.0  # [s]
COMFORTABLE = 0.8  # load at which more samples are tried: what they cost beside the rest varies


class Setting(NamedTuple):
    """What a twin can give up for time."""

    tolerance: float
    sample_rate: float  # [Hz] of the waveform


def settings_of(tolerances: Sequence[float], sample_rate: float) -> list[Setting]:
    """A ladder, the best last: all `tolerances` at the full rate, below them halves of the rate.

    Args:
        tolerances: the loosest first.
        sample_rate: of the waveform [Hz]; halves of it are taken at the loosest tolerance.
    """
    halves = [sample_rate / 2**n for n in range(HALVINGS, 0, -1)]
    thinned = [Setting(tolerances[0], rate) for rate in halves if rate >= LOWEST_SAMPLE_RATE]
    return thinned + [Setting(tolerance, sample_rate) for tolerance in tolerances]


class Affordable:
    """Chooses among the settings of a ladder by the cost of windows.

    The share is one of the processor's time, lateness one of wall time, see `observe`.

    Two windows in a row that cost more than the time there is, or a mean over half a second above
    what is granted, step down at once, by as many rungs as that asks for at least. A tolerance is
    granted the share, the full waveform all the time there is: it is thinned where the twin would
    be late otherwise, and not before.

    A mean within the grant must last before a better rung is tried: several at once as long as
    none of them can cost too much, then one by one: a tolerance as long as it cannot be late, a
    fuller waveform as long as there is some time left. Where that proves too dear, from then on a
    mean must last twice as long, and of a tolerance it is remembered by how much; so a cost at the
    limit does not let the setting swing.

    Windows that are repeated lead back up to the rung to begin with, no higher: they do not show
    what a tolerance costs, but a short overload, as of the start of other processes, must not keep
    the tolerance loose for good.

    Args:
        ladder: of `settings_of`.
        share: of the time there is, that windows may cost in the mean.
        period: time there is for a window [s].
        begin: to begin with; where the ladder lacks it, the next better one.
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
        self._windows = max(math.ceil(STRETCH / period - 1e-9), FEWEST)
        self._loads: list[float] = []
        self._last = 0.0
        self._repeated = False
        self._climbed_at = math.nan  # mean at which the rung in use was tried
        self.load = math.nan
        """Cost over the time there is, as last judged."""
        self.relearn()

    @property
    def automatic(self) -> bool:
        """Whether there is a choice of tolerances."""
        return self._full < len(self._ladder) - 1

    @property
    def setting(self) -> Setting:
        """The one to use for the next window."""
        return self._ladder[self._rung]

    @property
    def full_sample_rate(self) -> float:
        """Of a waveform that is not thinned [Hz]."""
        return self._ladder[-1].sample_rate

    def relearn(self) -> None:
        """Forget what was too dear: the operating point is another one."""
        self._patience = PATIENCE
        self._calm = 0.0
        self._dearer = [1.0] * len(self._ladder)  # than the next worse; at first anything may do

    def observe(self, cost: float, work: float, repeated: bool = False) -> None:
        """Learn from a window.

        One in time costs what the processor worked for it: that other processes held it up says
        nothing of a setting. A late one costs all the time it took, whatever took it.

        Args:
            cost: wall time that it took [s].
            work: processor time of it [s].
            repeated: whether it was not computed; then it says nothing of what a tolerance costs,
                but if it is late, then at any tolerance.
        """
        load = (work if cost <= self._period else cost) / self._period
        if repeated != self._repeated:
            self._repeated = repeated
            self._forget()
        late, self._last = min(load, self._last), load
        self._loads.append(load)
        if late > 1.0:
            self.load = late
            self._descend(late)
        elif len(self._loads) >= self._windows:
            self.load = sum(self._loads) / len(self._loads)
            self._judge(self.load)

    def _judge(self, mean: float) -> None:
        """Decide by the mean of a stretch."""
        if mean > self._grant(self._rung):
            self._descend(mean)
            return
        goal = self._goal(mean)
        self._calm = self._calm + len(self._loads) * self._period if goal > self._rung else 0.0
        self._loads.clear()
        if self._calm >= self._patience:
            self._move(goal)
            self._climbed_at = mean

    def _goal(self, mean: float) -> int:
        """The rung to climb to."""
        top = max(self._full, self._first) if self._repeated else len(self._ladder) - 1
        goal, most = self._rung, mean
        while goal < top and (most := most * self._steepest(goal + 1)) <= self._limit(goal + 1):
            goal += 1
        return self._rung + 1 if goal == self._rung < top and self._may_climb(mean) else goal

    def _may_climb(self, mean: float) -> bool:
        """Whether the next rung is worth a trial."""
        above = self._rung + 1
        if above <= self._full:
            return mean <= COMFORTABLE
        return mean * DEARER < 1.0 and mean * self._dearer[above] <= self._share

    def _descend(self, load: float) -> None:
        if self._climbed_at < load:
            self._patience = min(2.0 * self._patience, LONGEST_PATIENCE)
            self._dearer[self._rung] = min(load / self._climbed_at, self._steepest(self._rung))
        rung = self._rung
        while rung and load > self._grant(rung):
            load /= self._steepest(rung)
            rung -= 1
        self._move(rung)

    def _grant(self, rung: int) -> float:
        """The load above which `rung` is left for the next worse one."""
        return 1.0 if self._repeated else self._limit(rung)

    def _limit(self, rung: int) -> float:
        """The load up to which `rung` is tried."""
        return self._share if rung > self._full else 1.0

    def _steepest(self, rung: int) -> float:
        """What `rung` may cost over the next worse one, at most."""
        if rung <= self._full:
            return 2.0
        return 1.0 if self._repeated else DEARER

    def _move(self, rung: int) -> None:
        self._rung = rung
        self._climbed_at = math.nan
        self._forget()

    def _forget(self) -> None:
        """Begin a new stretch."""
        self._last = self._calm = 0.0
        self._loads.clear()


def _rank(setting: Setting) -> tuple[float, float]:
    """The better, the greater."""
    return setting.sample_rate, -setting.tolerance
