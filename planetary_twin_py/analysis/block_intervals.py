"""Confidence intervals of indicators from the turns of which an average consists.

The jackknife (Quenouille 1956, Biometrika 43, 353-360; Tukey 1958): the turns are divided into B
blocks, and the indicator is computed without each block. With pseudo-values B t - (B - 1) t_(-b),
t -+ q s/sqrt(B), where s is their standard deviation and q the quantile of Student's t with B - 1
degrees of freedom. The scatter is that of an average of this many turns. Noise that is left in the
average moves an indicator as well, in one direction, which no interval shows.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.stats import t as student

Array = NDArray[np.float64]
FEWEST_BLOCKS = 6
MOST_BLOCKS = 20
CONFIDENCE = 0.95


class Interval(NamedTuple):
    """A value with its confidence interval of 95 %."""

    value: float
    """Of the average over all turns."""
    low: float
    """Lower limit; NaN where there is none."""
    high: float
    """Upper limit; NaN where there is none."""


def blocks_of(turns: int) -> int:
    """Number of blocks into which turns are divided: if possible, one that leaves no turn out.

    Args:
        turns: number of turns.

    Raises:
        ValueError: there are fewer than six.
    """
    if turns < FEWEST_BLOCKS:
        raise ValueError(
            f"turns: {turns}: must be at least {FEWEST_BLOCKS}, or the scatter is not known"
        )
    most = min(turns, MOST_BLOCKS)
    return max(range(FEWEST_BLOCKS, most + 1), key=lambda count: (turns % count == 0, count))


def jackknife(turns: Array, figures: Callable[[Array], Mapping[str, float]]) -> dict[str, Interval]:
    """Figures of an average with their intervals.

    Args:
        turns: signal of each turn, in any unit, (turns, points).
        figures: figures of an average (points,), by name.

    Returns:
        The figures of the average over all turns, by name. An interval is NaN if the figure is not
        defined without some block.

    Raises:
        ValueError: there are fewer than six turns.
    """
    count = blocks_of(len(turns))
    length = len(turns) // count
    blocks = turns[: count * length].reshape(count, length, -1).mean(axis=1)
    without = [figures((blocks.sum(axis=0) - block) / (count - 1)) for block in blocks]
    return {
        name: _interval(value, np.array([one[name] for one in without]))
        for name, value in figures(turns.mean(axis=0)).items()
    }


def _interval(value: float, without: Array) -> Interval:
    count = len(without)
    pseudo = count * value - (count - 1) * without
    error = float(pseudo.std(ddof=1)) / math.sqrt(count)
    reach = float(student.ppf(0.5 + 0.5 * CONFIDENCE, count - 1)) * error
    return Interval(value, value - reach, value + reach)
