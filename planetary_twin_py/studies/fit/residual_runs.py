"""Tests whether residuals are noise, by the number of their runs of one sign.

Wald and Wolfowitz 1940, Ann. Math. Stat. 11, 147-162: among n1 positive and n2 negative values in
random order, the number of runs has the mean 1 + 2 n1 n2/n and the variance
2 n1 n2 (2 n1 n2 - n)/(n^2 (n - 1)). With fewer runs, neighbours tend to have the same sign: an
effect that changes slowly from one reading to the next is not modelled.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .readings import Array

FEWEST = 12  # residuals above which the number of runs is nearly normally distributed
CHANCE = 0.01  # probability below which residuals are not noise


class Runs(NamedTuple):
    """Runs of one sign."""

    runs: int
    expected: float
    """Number of runs of values in random order."""
    probability: float
    """Probability of so few runs or fewer, if the values are in random order."""

    @property
    def noise(self) -> bool:
        """Whether values in random order explain the number of runs."""
        return self.probability >= CHANCE


def count_runs(residuals: Array) -> Runs | None:
    """Runs above and below the median in the order of the readings; None for too few values."""
    above = np.asarray(residuals) > np.median(residuals)
    n, first = len(above), int(above.sum())
    second = n - first
    if n < FEWEST or min(first, second) == 0:
        return None
    count = 1 + int(np.count_nonzero(above[1:] != above[:-1]))
    pairs = 2.0 * first * second
    expected = 1.0 + pairs / n
    variance = pairs * (pairs - n) / (n**2 * (n - 1.0))
    score = (count + 0.5 - expected) / math.sqrt(variance)
    return Runs(count, expected, 0.5 * math.erfc(-score / math.sqrt(2.0)))
