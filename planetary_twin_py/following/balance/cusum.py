"""Cumulative sums of standardised innovations of gearboxes, for steps of either sign (Page 1954,
Biometrika 41, 100-115)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

KAPPA = 0.5  # half of the step that is detected fastest, in standard deviations of one term
YEAR = 365.25 * 86_400.0  # [s]
OVERSHOOT = 1.166  # mean excess of a sum over its limit (Siegmund 1985, ch. 10)
TERM = 1.0  # [s] over which innovations are averaged
CLIP = 5.0  # largest magnitude with which a single innovation counts
CORRELATED = (
    0.2  # mean product of successive standardised innovations above which there is no alarm
)
MEMORY = 60.0  # [s] time constant of that correlation, or 50 innovations
TRUSTED = 30.0  # [s] after which the correlation is known, or 30 innovations
SIGNS = np.array([1.0, -1.0])[:, None]


def limit(interval: float, term: float = TERM) -> float:
    """Limit of a sum for one false alarm of a gearbox in an interval [s] of white innovations.

    The average run length of one sum is 2 exp(h + 1.166) terms for kappa = 1/2 (Siegmund 1985);
    each gearbox has two.
    """
    return math.log(interval / term) - OVERSHOOT


LIMIT = limit(0.5 * YEAR)  # 15.4


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
class Cusum:
    """Two sums, one for each sign, of each gearbox."""

    count: int = 1
    limit: float = LIMIT
    term: float = TERM

    def __post_init__(self) -> None:
        shape = 2, self.count
        self.value = np.zeros(shape)
        """The sums, (2, n)."""
        self._since = np.full(shape, math.nan)
        self._totals = np.zeros((3, *shape))  # weighted values and losses, weights; since then
        self._held = np.zeros(shape, dtype=bool)
        self.waiting = np.zeros(self.count, dtype=bool)
        """Mask of the gearboxes whose alarms wait, (n,)."""
        self._moments = np.array([np.zeros(self.count), np.ones(self.count)])
        """Mean products of successive standardised innovations, and mean squares."""
        self._moments_before = np.tile(self._moments[:, None], (1, 2, 1))  # when a sum left zero
        self._last, self._known = np.full(self.count, math.nan), np.zeros(self.count)
        self._sums = np.zeros((5, self.count))  # scores, readings, and terms of `_totals`
        self._begin = math.nan

    @property
    def correlation(self) -> Array:
        """Correlations of successive innovations over the last minute, within -1 and 1, (n,)."""
        covariance, variance = self._moments
        return np.clip(covariance / np.where(variance > 0.0, variance, math.inf), -1.0, 1.0)

    @property
    def held(self) -> Mask:
        """Whether correlated innovations suppress the alarm of a sum that leaves zero now, (n,).

        A step makes innovations correlate, too, so the correlation before the step decides.
        Innovations that scatter more than expected count as more correlated than they are.
        """
        return (self._known >= TRUSTED) & (self._moments[0] > CORRELATED)

    def restart(self, which: Mask, time: float, forget: bool = False) -> None:
        """Start the sums of a mask of gearboxes, (n,), from zero.

        A step made their innovations correlate: the correlation is then that of before the step, or
        none if it is forgotten.
        """
        larger = np.argmax(self.value, axis=0)
        before = np.take_along_axis(self._moments_before, larger[None, None], axis=1)[:, 0]
        self._moments = np.where(which, before, self._moments)
        if forget:
            self._moments[:, which] = [[0.0], [1.0]]
            self._known[which], self._last[which] = 0.0, math.nan
        self._moments_before[:, :, which] = self._moments[:, None, which]
        for sums in (self.value, self._totals, self._sums):
            sums[..., which] = 0.0
        self._since[:, which] = time
        self._held[:, which] = self.held[which]

    def add(self, time: float, value: Array, sd: Array, loss: Array, step: float) -> Steps:
        """Add innovations [N m], (n,), `step` [s] after the last; return the steps found.

        `sd` are their expected standard deviations, and `loss` the loss torques of the scene. The
        sums of gearboxes with a step start from zero. NaN is no reading.
        """
        score = np.clip(value / sd, -CLIP, CLIP)
        has_reading = np.isfinite(score)
        self._update_moments(score, has_reading, step)
        weight = 1.0 / sd**2
        terms = np.stack([score, np.ones(self.count), weight * value, weight * loss, weight])
        self._sums += np.where(has_reading, terms, 0.0)
        if math.isnan(self._begin):
            self._begin, self._since[:] = time - step, time - step
        if time < self._begin + self.term - 0.5 * step:
            return NONE
        self._begin = time
        return self._end_term(time)

    def _end_term(self, time: float) -> Steps:
        score, readings, *terms = self._sums
        has_reading = readings > 0.0
        term = score / np.sqrt(np.maximum(readings, 1.0))
        self.value = np.where(has_reading, self.value + SIGNS * term - KAPPA, self.value)
        self._totals += np.where(has_reading, np.array(terms), 0.0)[:, None]
        zero = self.value <= 0.0
        self.value[zero] = 0.0
        self._totals[:, zero] = 0.0
        self._since[zero] = time
        self._held = np.where(zero, self.held, self._held)
        self._moments_before = np.where(zero, self._moments[:, None], self._moments_before)
        self._sums[:] = 0.0
        alarms = (self.value > self.limit) & ~self._held & ~self.waiting
        if not alarms.any():
            return NONE
        side, gearbox = np.nonzero(alarms)
        value, loss, weight = self._totals[:, side, gearbox]
        steps = Steps(gearbox, self._since[side, gearbox], value / weight, value / loss)
        self.restart(alarms[0] | alarms[1], time)
        return steps

    def _update_moments(self, score: Array, has_reading: Mask, step: float) -> None:
        successive = has_reading & np.isfinite(self._last)
        share = np.where(successive, min(step / MEMORY, 0.02), 0.0)
        moments = np.where(successive, [score * self._last, score**2], 0.0)
        self._moments = self._moments + share * (moments - self._moments)
        self._known += np.where(successive, min(step, 1.0), 0.0)
        self._last = np.where(has_reading, score, self._last)
