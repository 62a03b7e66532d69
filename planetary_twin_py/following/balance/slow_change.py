"""Names a friction level that has drifted, too slowly for any step to be found.

It is the level that alone explains the balances: whether friction, drag or a sensor has changed is
not known.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from ...text.intervals import plus_minus
from ..estimate import CONFIDENT

SETTLED = 120.0  # [s] after which the first estimates no longer depend on the prior
EVERY = 10.0  # [s] between two estimates
SMALLEST = 0.05  # change of the level that is named


class _Level(NamedTuple):
    time: float
    value: float
    half: float

    def __str__(self) -> str:
        return f"{plus_minus(self.value, self.half)} at {self.time:.0f} s"


@dataclass
class SlowChange:
    """Compares the present friction level with that of the beginning."""

    _begin: float | None = field(default=None, init=False)  # [s]
    _first: _Level | None = field(default=None, init=False)
    _last: _Level | None = field(default=None, init=False)

    def due(self, time: float) -> bool:
        """Whether an estimate is due at a time [s]."""
        return self._last is None or time >= self._last.time + EVERY

    def add(self, time: float, value: float, sd: float) -> None:
        """Add an estimate of the friction level and its standard deviation."""
        self._begin = time if self._begin is None else self._begin
        self._last = _Level(time, value, CONFIDENT * sd)
        if self._first is None and time - self._begin >= SETTLED:
            self._first = self._last

    def remarks(self) -> Iterator[str]:
        """A line if the 95 % intervals of the first and of the last level do not overlap."""
        first, last = self._first, self._last
        if first is None or last is None:
            return
        if abs(last.value - first.value) > max(first.half + last.half, SMALLEST):
            yield (
                f"friction_level has drifted from {first} to {last}, without a step: friction or a "
                "torque sensor has changed slowly"
            )
