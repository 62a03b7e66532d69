"""Estimates of the parameters with confidence intervals, from residuals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from .identifiability import correlation, insensitive_range, split
from .intervals import ConfidenceInterval, intervals
from .least_squares import Array, Minimum, Residuals, explained
from .parameter import Parameter


@dataclass(frozen=True)
class Estimate:
    """Estimates of the p parameters, in SI, and their uncertainty."""

    values: Array
    """(p,); meaningless for parameters that are not identifiable."""
    intervals: tuple[ConfidenceInterval, ...]
    """Confidence intervals; for a parameter that is not identifiable, the range of values that
    fit equally with the others fixed, or NaN if only a combination is identifiable."""
    correlation: Array
    """(p, p), NaN for parameters that are not identifiable."""
    not_identifiable: tuple[tuple[int, ...], ...]
    """Indices of parameters that are not identifiable; several of which only a combination is
    identifiable form one group."""
    covariance: Array
    """(p, p), of the identifiable directions, if noise explained the residuals."""
    unbounded: Array
    """(p,); minimum of the sum of squares without the ranges, to first order."""
    at_bound: tuple[bool, ...]
    """Whether `unbounded` is outside the range, so that the estimate is at its end."""
    excess: float
    """Reduced chi-squared that widens the intervals; 1 if noise explains the residuals."""

    def identifiable(self, place: int) -> bool:
        """Whether the parameter with this index is identifiable.

        Args:
            place: index of the parameter.
        """
        return all(place not in members for members in self.not_identifiable)


def conclude(
    residuals: Residuals,
    parameters: Sequence[Parameter],
    minimum: Minimum,
    freedom: float,
    confidence: float,
) -> Estimate:
    """Estimate parameters and their uncertainty at a minimum of the sum of squares.

    `freedom` are the degrees of freedom of the noise estimate, and `confidence` is the level of the
    intervals.
    """
    from scipy.stats import t

    degrees = len(minimum.residuals) - len(parameters)
    excess = 1.0 if explained(minimum) else minimum.sum / max(degrees, 1)
    rise = float(t.ppf(0.5 + 0.5 * confidence, freedom)) ** 2 * excess
    linear = split(minimum, parameters, rise**0.5)
    bounds = intervals(residuals, parameters, minimum, linear, rise)
    for k in range(len(parameters)):
        if (k,) in linear.groups:
            ends = insensitive_range(residuals, parameters, minimum, k, rise)
            bounds[k] = ConfidenceInterval(*ends, True)
        elif not linear.identifiable(k):
            bounds[k] = ConfidenceInterval(math.nan, math.nan, True)
    unbounded = minimum.values - linear.covariance @ (minimum.slopes.T @ minimum.residuals)
    bound = tuple(
        bool(value < p.low or value > p.high)
        for value, p in zip(unbounded, parameters, strict=True)
    )
    return Estimate(
        values=minimum.values,
        intervals=tuple(bounds[k] for k in range(len(parameters))),
        correlation=correlation(linear),
        not_identifiable=linear.groups,
        covariance=linear.covariance,
        unbounded=unbounded,
        at_bound=bound,
        excess=excess,
    )
