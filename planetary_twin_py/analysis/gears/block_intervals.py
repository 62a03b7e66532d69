"""Confidence intervals of indicators from the turns of which an average consists.

The jackknife (Quenouille 1956, Biometrika 43, 353-360; Tukey 1958): the turns are divided into B
blocks, and the indicator is computed without each block. With pseudo-values B t - (B - 1) t_(-b),
t -+ q s/sqrt(B), where s is their standard deviation and q the quantile of Student's t with B - 1
degrees of freedom. The scatter is that of an average of this many turns. Noise that is left in the
average moves an indicator as well, in one direction, which no interval shows.

The jackknife is not consistent for a maximum (Efron and Tibshirani 1993, An Introduction to the
Bootstrap, ch. 11): intervals of peak and FM0 would be 1.5 to 2 times as wide as they scatter. They
are those of a bootstrap (ch. 6): sums of blocks with random weights, whose sum is 0 and whose
squares sum to 1/B, are noise like that of the average. It is added to the repeating part of the
average: the orders whose power is above that of noise alone, less that power. The scatter with 150
such records is the standard error. Higher moments stay with the jackknife: of a burst below the
noise the repeating part would lack most, and their intervals would be half as wide as they scatter.
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
RECORDS = 150  # of other noise: their scatter is known to 6 %
ABOVE = 4.0  # power of an order over that of its noise: 2 % of noise alone are above
SEED = 1


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
    blocks = _blocks(turns)
    count = len(blocks)
    without = [figures((blocks.sum(axis=0) - block) / (count - 1)) for block in blocks]
    found = {}
    for name, value in figures(turns.mean(axis=0)).items():
        pseudo = count * value - (count - 1) * np.array([one[name] for one in without])
        found[name] = _interval(value, float(pseudo.std(ddof=1)) / math.sqrt(count), count)
    return found


def bootstrap(turns: Array, figures: Callable[[Array], Mapping[str, float]]) -> dict[str, Interval]:
    """Figures of an average that are maxima, with their intervals.

    Args:
        turns: as of `jackknife`.
        figures: as of `jackknife`.

    Returns:
        As of `jackknife`; an interval is NaN if the figure is not defined with some noise.

    Raises:
        ValueError: there are fewer than six turns.
    """
    blocks = _blocks(turns)
    repeating = _repeating(blocks)
    records = [figures(repeating + noise) for noise in _noise(blocks)]
    return {
        name: _interval(value, float(np.std([one[name] for one in records], ddof=1)), len(blocks))
        for name, value in figures(turns.mean(axis=0)).items()
    }


def _blocks(turns: Array) -> Array:
    """Means over blocks of successive turns, (blocks, points)."""
    count = blocks_of(len(turns))
    length = len(turns) // count
    return np.asarray(turns[: count * length].reshape(count, length, -1).mean(axis=1))


def _repeating(blocks: Array) -> Array:
    """Part of the average that is not noise, (points,)."""
    count, points = blocks.shape
    spectra = np.fft.rfft(blocks, axis=1)
    average = spectra.mean(axis=0)
    noise = np.sum(np.abs(spectra - average) ** 2, axis=0) / (count * (count - 1))
    power = np.abs(average) ** 2
    share = np.divide(noise, power, out=np.ones_like(power), where=power > ABOVE * noise)
    return np.asarray(np.fft.irfft(average * np.sqrt(1.0 - share), points))


def _noise(blocks: Array) -> Array:
    """Noise like that of the average, (records, points)."""
    count = len(blocks)
    weights = np.random.default_rng(SEED).standard_normal((RECORDS, count))
    weights -= weights.mean(axis=1, keepdims=True)
    weights /= np.linalg.norm(weights, axis=1, keepdims=True)
    return np.asarray(weights @ blocks) / math.sqrt(count)


def _interval(value: float, error: float, blocks: int) -> Interval:
    reach = float(student.ppf(0.5 + 0.5 * CONFIDENCE, blocks - 1)) * error
    return Interval(value, value - reach, value + reach)
