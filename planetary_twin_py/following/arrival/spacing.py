"""Warns of readings that are far apart: the unit of their time may be wrong."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

APART = 0.5  # [s] between most readings above which the unit of the time may be wrong
FEW = 10  # steps below which the spacing of readings is not judged


@dataclass
class Spacing:
    """Times between successive bins with readings."""

    first: float = math.nan  # [s]
    last: float = math.nan  # [s]
    steps: int = 0
    wide: int = 0  # steps longer than `APART`

    def add(self, time: float) -> None:
        """Add the end of a bin [s]."""
        if math.isnan(self.first):
            self.first = time
        else:
            self.steps += 1
            self.wide += time - self.last > APART
        self.last = time

    def remarks(self, period: float) -> Iterator[str]:
        """A line if most readings are apart more than a bin, as in a wrong unit of the time."""
        if self.steps < FEW or self.wide <= 0.5 * self.steps:
            return
        mean = (self.last - self.first) / self.steps
        yield (
            f"readings are {mean:.3g} s apart, a bin has {period:g} s: is the unit of the time "
            "right? The header.stamp of a message has s and ns; a table in milliseconds needs the "
            "heading time [ms]; readings that are so slow are for fleet"
        )
