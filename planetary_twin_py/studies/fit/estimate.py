"""An estimate of the parameters with its intervals, from residuals alone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from .identifiability import correlation, split, unseen
from .intervals import Interval, intervals
from .least_squares import Array, Minimum, Residuals, explained
from .parameter import Parameter


@dataclass(frozen=True)
class Estimate:
    """What residuals tell of the parameters."""

    values: Array
    """(p,); without meaning where not told."""
    intervals: tuple[Interval, ...]
    """Where the truth lies; of what is not told, values tried with the others held, NaN where
    several are told only together."""
    correlation: Array
    """(p, p), NaN beside what is not told."""
    untold: tuple[tuple[int, ...], ...]
    """Parameters that are not told: alone, or several that are told only together."""
    unbounded: Array
    """(p,); where the sum of squares would be least without the ranges, to first order."""
    at_bound: tuple[bool, ...]
    """Whether that lies beyond an end of the range, at which the estimate then stands."""
    excess: float
    """What is left over what noise leaves, by which the intervals are widened; 1: no more."""

    def told(self, place: int) -> bool:
        """Whether there is an estimate of a parameter."""
        return all(place not in members for members in self.untold)


def conclude(
    residuals: Residuals,
    parameters: Sequence[Parameter],
    minimum: Minimum,
    freedom: float,
    confidence: float,
) -> Estimate:
    """The estimate at a minimum.

    Args:
        residuals: see `least_squares.Residuals`.
        parameters: what is free.
        minimum: where the sum of squares is least.
        freedom: degrees of freedom to which the noise is known.
        confidence: of the intervals, within 0 and 1.
    """
    from scipy.stats import t

    left = len(minimum.residuals) - len(parameters)
    excess = 1.0 if explained(minimum) else minimum.sum / max(left, 1)
    rise = float(t.ppf(0.5 + 0.5 * confidence, freedom)) ** 2 * excess
    told = split(minimum, parameters, rise**0.5)
    found = intervals(residuals, parameters, minimum, told, rise)
    for k in range(len(parameters)):
        if (k,) in told.untold:
            found[k] = Interval(*unseen(residuals, parameters, minimum, k, rise), True)
        elif told.lost(k):
            found[k] = Interval(math.nan, math.nan, True)
    unbounded = minimum.values - told.covariance @ (minimum.slopes.T @ minimum.residuals)
    bound = tuple(
        bool(value < p.low or value > p.high)
        for value, p in zip(unbounded, parameters, strict=True)
    )
    return Estimate(
        values=minimum.values,
        intervals=tuple(found[k] for k in range(len(parameters))),
        correlation=correlation(told),
        untold=told.untold,
        unbounded=unbounded,
        at_bound=bound,
        excess=excess,
    )
