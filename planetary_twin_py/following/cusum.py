"""Cumulative sums of standardised innovations, for steps of either sign (Page 1954, Biometrika 41,
100-115)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

KAPPA = 0.5  # half of the step that is detected fastest, in standard deviations of one term
LIMIT = 15.4  # of a sum; one false alarm in half a year of independent normal terms of 1 s
TERM = 1.0  # [s] over which innovations are averaged
CLIP = 5.0  # largest magnitude with which a single innovation counts
CORRELATED = (
    0.2  # mean product of successive standardised innovations above which there is no alarm
)
MEMORY = 60.0  # [s] time constant of that correlation
TRUSTED = 30.0  # [s] after which the correlation is known


class Step(NamedTuple):
    """A detected step."""

    since: float
    """Time at which the sum left zero [s]."""
    found: float
    """[s]."""


class _Moments(NamedTuple):
    """Of innovations over their expected standard deviations, over the last minute."""

    covariance: float
    """Mean product of successive ones."""
    variance: float
    """Mean square."""


UNKNOWN = _Moments(0.0, 1.0)


@dataclass
class _Sum:
    sign: float
    value: float = 0.0
    since: float = math.nan
    moments: _Moments = UNKNOWN  # of innovations at that time
    held: bool = False

    def add(self, term: float, time: float, moments: _Moments, held: bool) -> None:
        self.value += self.sign * term - KAPPA
        if self.value <= 0.0:
            self.value, self.since = 0.0, time
            self.moments, self.held = moments, held


@dataclass
class Cusum:
    """Two sums, one for each sign."""

    moments: _Moments = UNKNOWN
    """Of the innovations over the last minute."""
    _sums: tuple[_Sum, _Sum] = field(default_factory=lambda: (_Sum(1.0), _Sum(-1.0)))
    _term: list[float] = field(default_factory=list)  # scores
    _begin: float | None = None
    _last: tuple[float, float] | None = None  # time and score
    _observed: float = 0.0  # [s] of innovations in the correlation

    def add(self, time: float, value: float, sd: float) -> Step | None:
        """Add an innovation.

        Args:
            time: time of the innovation [s].
            value: innovation [N m].
            sd: its expected standard deviation [N m].

        Returns:
            The step, if one is detected now; the sums then start from zero.
        """
        score = max(-CLIP, min(CLIP, value / sd))
        self._update_moments(time, score)
        if self._begin is None:
            self._begin = time
            for one_sided in self._sums:
                one_sided.since = time
        step = None
        if self._term and time >= self._begin + TERM:
            step = self._end_term(time)
            self._begin = time
        self._term.append(score)
        return step

    @property
    def correlation(self) -> float:
        """Correlation of successive innovations over the last minute, within -1 and 1."""
        covariance, variance = self.moments
        return max(-1.0, min(1.0, covariance / variance)) if variance > 0.0 else 0.0

    @property
    def held(self) -> bool:
        """Whether correlated innovations suppress the alarm of a sum that leaves zero now.

        A step makes innovations correlate, too, so the correlation before the step decides.
        Innovations that scatter more than expected count as more correlated than they are.
        """
        return self._observed >= TRUSTED and self.moments.covariance > CORRELATED

    def _end_term(self, time: float) -> Step | None:
        term = sum(self._term) / math.sqrt(len(self._term))
        self._term.clear()
        for one_sided in self._sums:
            one_sided.add(term, time, self.moments, self.held)
        for one_sided in self._sums:
            if one_sided.value > LIMIT and not one_sided.held:
                step = Step(one_sided.since, time)
                self.restart(time)
                return step
        return None

    def restart(self, time: float) -> None:
        """Start both sums from zero after a step, which has made innovations correlate.

        Args:
            time: present time [s].
        """
        self.moments = max(self._sums, key=lambda one_sided: one_sided.value).moments
        self._term.clear()
        self._begin = time
        self._sums = (_Sum(1.0, since=time), _Sum(-1.0, since=time))
        for one_sided in self._sums:
            one_sided.moments = self.moments

    def _update_moments(self, time: float, score: float) -> None:
        if self._last is not None:
            step = time - self._last[0]
            share = min(step / MEMORY, 0.1)
            covariance, variance = self.moments
            self.moments = _Moments(
                covariance + share * (score * self._last[1] - covariance),
                variance + share * (score**2 - variance),
            )
            self._observed += step
        self._last = time, score
