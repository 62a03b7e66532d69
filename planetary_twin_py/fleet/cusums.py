"""Cumulative sums of standardised innovations of many gearboxes, see `following.cusum`."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..following.cusum import CLIP, CORRELATED, KAPPA, MEMORY

Array = NDArray[np.float64]

TERM = 60.0  # [s] over which innovations are averaged: single readings are too noisy for 5 %
YEAR = 365.25 * 86_400.0  # [s] in which the whole fleet has one false alarm
KNOWN = 30.0  # successive readings from which their correlation is known
OVERSHOOT = 1.166  # mean excess of a sum over its limit (Siegmund 1985, ch. 10)


def limit(count: int, step: float) -> float:
    """Limit of a sum for one false alarm of the fleet in a year of white normal innovations.

    The average run length of one sum is 2 exp(h + 1.166) terms for kappa = 1/2 (Siegmund 1985);
    each gearbox has two.

    Args:
        count: number of gearboxes.
        step: time between two readings [s].

    Returns:
        The limit h.
    """
    return math.log(count * YEAR / max(step, TERM)) - OVERSHOOT


class Steps(NamedTuple):
    """Steps that are detected at one time, (m,) each."""

    gearbox: NDArray[np.int64]
    """Indices of the gearboxes."""
    since: Array
    """Times at which the sums left zero [s]."""
    size: Array
    """Means of the innovations since then [N m]."""
    share: Array
    """Sizes over the means of the scene's loss since then, with the same weights."""


NONE = Steps(np.zeros(0, dtype=np.int64), *np.zeros((3, 0)))


@dataclass
class Cusums:
    """Two sums, one for each sign, of each gearbox.

    Args:
        count: number of gearboxes.
        limit: limit of a sum above which a step is detected.
    """

    count: int
    limit: float

    def __post_init__(self) -> None:
        shape = 2, self.count
        self._value, self._since = np.zeros(shape), np.full(shape, math.nan)
        self._totals = np.zeros((3, *shape))  # weighted values and losses, weights; since then
        self._held = np.zeros(shape, dtype=bool)
        self.waiting = np.zeros(self.count, dtype=bool)
        """Mask of the gearboxes whose alarms wait, (n,)."""
        self.correlation = np.zeros(self.count)
        """Mean product of successive standardised innovations, (n,)."""
        self._sums = np.zeros((5, self.count))  # scores, readings, and terms of `_totals`
        self._begin = math.nan
        self._last, self._known = np.full(self.count, math.nan), np.zeros(self.count)

    def restart(self, which: NDArray[np.bool_], time: float) -> None:
        """Start the sums of some gearboxes from zero, without their past.

        Args:
            which: mask of the gearboxes, (n,).
            time: present time [s].
        """
        for sums in (self._value, self._totals, self._sums):
            sums[..., which] = 0.0
        self._since[:, which], self._held[:, which] = time, False
        self.correlation[which] = self._known[which] = 0.0
        self._last[which] = math.nan

    def add(self, time: float, value: Array, sd: Array, loss: Array, step: float) -> Steps:
        """Add an innovation of each gearbox.

        Args:
            time: time of the innovations [s].
            value: innovations [N m], (n,); NaN without a reading.
            sd: expected standard deviations [N m], (n,).
            loss: loss torques of the scene [N m], (n,).
            step: time between two readings [s].

        Returns:
            Steps that are detected now; their sums then start from zero.
        """
        score = np.clip(value / sd, -CLIP, CLIP)
        has_reading = np.isfinite(score)
        self._update_correlation(score, has_reading, step)
        weight = 1.0 / sd**2
        terms = np.stack([score, np.ones(self.count), weight * value, weight * loss, weight])
        self._sums += np.where(has_reading, terms, 0.0)
        if math.isnan(self._begin):
            self._begin, self._since[:] = time - step, time - step
        if time < self._begin + TERM - 0.5 * step:
            return NONE
        self._begin = time
        return self._end_term(time)

    def _end_term(self, time: float) -> Steps:
        score, readings, *terms = self._sums
        has_reading = readings > 0.0
        term = score / np.sqrt(np.maximum(readings, 1.0))
        held = (self._known >= KNOWN) & (self.correlation > CORRELATED)
        for sign, row in ((1.0, 0), (-1.0, 1)):
            sums = self._value[row]
            sums[has_reading] += (sign * term - KAPPA)[has_reading]
            zero = sums <= 0.0
            sums[zero] = 0.0
            self._totals[:, row, zero] = 0.0
            self._since[row][zero], self._held[row][zero] = time, held[zero]
            grows = has_reading & ~zero
            for total, added in zip(self._totals[:, row], terms, strict=True):
                total[grows] += added[grows]
        self._sums[:] = 0.0
        alarms = (self._value > self.limit) & ~self._held & ~self.waiting
        side, gearbox = np.nonzero(alarms)
        if not len(gearbox):
            return NONE
        value, loss, weight = self._totals[:, side, gearbox]
        steps = Steps(gearbox, self._since[side, gearbox].copy(), value / weight, value / loss)
        self._value[:, gearbox] = self._totals[:, :, gearbox] = 0.0
        self._since[:, gearbox] = time
        return steps

    def _update_correlation(
        self, score: Array, has_reading: NDArray[np.bool_], step: float
    ) -> None:
        """Update the mean product of successive innovations, over a minute or 50 of them."""
        successive = has_reading & np.isfinite(self._last)
        share = min(step / MEMORY, 0.02)
        change = np.where(successive, score * self._last - self.correlation, 0.0)
        self.correlation += share * change
        self._known += np.where(successive, 1.0, 0.0)
        self._last = np.where(has_reading, score, self._last)
