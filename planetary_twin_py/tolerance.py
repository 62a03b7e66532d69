"""The tightest tolerance a live twin can afford, from what its windows cost.

Pure arithmetic without a clock: whoever runs the twin measures, and feeds what it has measured.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

TOLERANCES = (1e-8, 0.1)  # allowed range
LADDER = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6)
"""Tolerances to choose from, the loosest first."""
AUTOMATIC = 0.0
"""Stands for the choice among all of `LADDER` where one tolerance could be named."""
LIVE_TOLERANCE = 3e-3  # as long as nothing is known of the machine
# The error of a step goes with the cube of its length at least (Rosenbrock's: the fourth power).
DEARER = (10.0 / 3.0) ** (1.0 / 3.0)  # what a rung may cost over the next looser one, at most
STRETCH = 0.5  # [s] over which a mean cost is taken
FEWEST = 4  # windows for that
PATIENCE = 1.0  # [s] a cost must have allowed for tightening
LONGEST_PATIENCE = 64.0  # [s]


def check_tolerance(tolerance: float) -> None:
    """Raise `ValueError` for one out of range."""
    if not TOLERANCES[0] <= tolerance <= TOLERANCES[1]:
        raise ValueError(
            f"tolerance = {tolerance!r}: must be within {TOLERANCES[0]:g} and {TOLERANCES[1]:g}"
        )


def ladder_of(tolerance: float) -> Sequence[float]:
    """The tolerances to choose from: `tolerance` alone, or all where it is AUTOMATIC.

    Raises:
        ValueError: it is neither AUTOMATIC nor in range.
    """
    if tolerance == AUTOMATIC:
        return LADDER
    try:
        check_tolerance(tolerance)
    except ValueError as refusal:
        raise ValueError(f"{refusal}, or {AUTOMATIC:g} for automatic") from None
    return (tolerance,)


class AffordableTolerance:
    """Chooses among the tolerances of a ladder by the cost of windows.

    Two windows in a row that cost more than the time there is, or a mean over half a second above
    the share that is granted, loosen at once, by as many rungs as that asks for at least.

    A mean within the share must last before a tighter rung is tried: several at once as long as
    none of them can cost too much, then one by one as long as none can be late. Where that proves
    too dear, it is remembered by how much, and from then on a mean must last twice as long; so a
    cost at the limit does not let the tolerance swing.

    Args:
        ladder: tolerances, the loosest first.
        share: of the time there is, that windows may cost in the mean.
        period: time there is for a window [s].
        tolerance: to begin with; the ladder's next tighter one is taken.
    """

    def __init__(
        self,
        ladder: Sequence[float],
        share: float,
        period: float,
        tolerance: float = LIVE_TOLERANCE,
    ) -> None:
        self._ladder = ladder
        self._share = share
        self._period = period
        self._rung = sum(rung > tolerance for rung in ladder[:-1])
        self._windows = max(math.ceil(STRETCH / period - 1e-9), FEWEST)
        self._loads: list[float] = []
        self._last = 0.0
        self._tightened_at = math.nan  # mean at which the rung in use was tried
        self.load = math.nan
        """Cost over the time there is, as last judged."""
        self.relearn()

    @property
    def automatic(self) -> bool:
        """Whether there is anything to choose."""
        return len(self._ladder) > 1

    @property
    def tolerance(self) -> float:
        """The one to use for the next window."""
        return self._ladder[self._rung]

    def relearn(self) -> None:
        """Forget what was too dear: the operating point is another one."""
        self._patience = PATIENCE
        self._calm = 0.0
        self._dearer = [1.0] * len(self._ladder)  # than the next looser; at first anything may do

    def observe(self, cost: float, repeated: bool = False) -> None:
        """Learn from a window that took `cost` [s] to compute.

        One that was `repeated` says nothing of what a tolerance costs.
        """
        load = cost / self._period
        if repeated:
            self.load = load
            self._last = 0.0
            self._loads.clear()
            return
        late, self._last = min(load, self._last), load
        self._loads.append(load)
        if late > 1.0:
            self.load = late
            self._loosen(late)
        elif len(self._loads) >= self._windows:
            self.load = sum(self._loads) / len(self._loads)
            self._judge(self.load)

    def _judge(self, mean: float) -> None:
        """Decide by the mean of a stretch."""
        if mean > self._share:
            self._loosen(mean)
            return
        room = self._room(mean)
        self._calm = self._calm + len(self._loads) * self._period if room else 0.0
        self._loads.clear()
        if self._calm >= self._patience:
            self._move(room)
            self._tightened_at = mean

    def _room(self, mean: float) -> int:
        """Rungs by which to tighten."""
        tighter = len(self._ladder) - 1 - self._rung
        if not tighter:
            return 0
        sure = math.log(self._share / mean) / math.log(DEARER) if mean > 0.0 else math.inf
        may = mean * self._dearer[self._rung + 1] <= self._share and mean * DEARER < 1.0
        return max(math.floor(min(sure, tighter)), int(may))

    def _loosen(self, load: float) -> None:
        if self._tightened_at < load:
            self._patience = min(2.0 * self._patience, LONGEST_PATIENCE)
            self._dearer[self._rung] = min(load / self._tightened_at, DEARER)
        self._move(-math.ceil(math.log(load / self._share) / math.log(DEARER)))

    def _move(self, rungs: int) -> None:
        self._rung = max(self._rung + rungs, 0)
        self._last = self._calm = 0.0
        self._tightened_at = math.nan
        self._loads.clear()
