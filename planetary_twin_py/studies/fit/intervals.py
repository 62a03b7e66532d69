"""Confidence intervals: from the curvature of the sum of squares or, if that is inaccurate, from
its profile."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .identifiability import LinearAnalysis
from .least_squares import Array, Minimum, Residuals, bounds_of, minimise
from .parameter import Parameter

DOUBTFUL = 0.3  # relative error of the expected rise above which the curvature is not used
FINE = 0.02  # accuracy of the end of a profile, in half-widths
FARTHEST = 2.0**12  # half-widths at which the search for an end stops


class ConfidenceInterval(NamedTuple):
    """A confidence interval in SI."""

    low: float
    high: float
    profiled: bool
    """Whether it follows from the profile of the sum of squares, not from the curvature."""


def intervals(
    residuals: Residuals,
    parameters: Sequence[Parameter],
    minimum: Minimum,
    linear: LinearAnalysis,
    rise: float,
) -> dict[int, ConfidenceInterval]:
    """Confidence intervals of the identifiable parameters.

    The covariance gives the ends for a linear model. If an end is beyond a bound, or the sum of
    squares rises differently there, the profile likelihood is used: all other parameters are
    estimated again at each value of the parameter. The least sum of squares increases by `rise` at
    the ends.
    """
    covariance = linear.covariance
    places = [k for k in range(len(parameters)) if linear.identifiable(k)]
    doubtful = _doubtful(residuals, parameters, minimum, covariance, places, rise)
    by_index = {}
    for k in places:
        parameter = parameters[k]
        half = math.sqrt(rise * covariance[k, k])
        ends = []
        for side, sign in enumerate((-1.0, 1.0)):
            if doubtful[k][side]:
                profile = _Profile(residuals, parameters, minimum, covariance, k)
                ends.append(profile.end(sign, half, rise))
            else:
                ends.append(float(minimum.values[k] + sign * half))
        low, high = max(ends[0], parameter.low), min(ends[1], parameter.high)
        by_index[k] = ConfidenceInterval(low, high, any(doubtful[k]))
    return by_index


def _doubtful(
    residuals: Residuals,
    parameters: Sequence[Parameter],
    minimum: Minimum,
    covariance: Array,
    places: Sequence[int],
    rise: float,
) -> dict[int, list[bool]]:
    """Whether the curvature misplaces the lower and the upper end of each interval."""
    low, high = bounds_of(parameters)
    points = [
        minimum.values + sign * math.sqrt(rise / covariance[k, k]) * covariance[:, k]
        for k in places
        for sign in (-1.0, 1.0)
    ]
    inside = [bool(np.all((point >= low) & (point <= high))) for point in points]
    evaluated = iter(
        residuals([point for point, within in zip(points, inside, strict=True) if within])
    )
    doubts = []
    for within in inside:
        end_residuals = next(evaluated) if within else None
        risen = (
            math.inf
            if end_residuals is None
            else float(end_residuals @ end_residuals) - minimum.sum
        )
        doubts.append(not abs(risen - rise) <= DOUBTFUL * rise)
    return {k: doubts[2 * n : 2 * n + 2] for n, k in enumerate(places)}


class _Profile:
    """The least sum of squares as a function of one parameter."""

    def __init__(
        self,
        residuals: Residuals,
        parameters: Sequence[Parameter],
        minimum: Minimum,
        covariance: Array,
        place: int,
    ) -> None:
        self._residuals, self._minimum, self._place = residuals, minimum, place
        self._others = [k for k in range(len(parameters)) if k != place]
        self._parameters = parameters
        self._ridge = covariance[:, place] / covariance[place, place]

    def end(self, sign: float, half: float, rise: float) -> float:
        """Value at which the profile has risen by `rise`, or the bound; infinite if neither."""
        from scipy.optimize import brentq

        centre = float(self._minimum.values[self._place])
        parameter = self._parameters[self._place]
        room = parameter.high - centre if sign > 0.0 else centre - parameter.low

        def beyond(away: float) -> float:
            return self._rise(sign * away) - rise

        inner, outer = 0.0, min(half, room)
        while outer > 0.0 and beyond(outer) < 0.0:
            if outer == room:
                return parameter.high if sign > 0.0 else parameter.low
            if outer > FARTHEST * half:
                return sign * math.inf
            inner, outer = outer, min(2.0 * outer, room)
        if outer == 0.0:
            return centre
        return centre + sign * float(brentq(beyond, inner, outer, xtol=FINE * half))

    def _rise(self, away: float) -> float:
        """Rise of the least sum of squares with the parameter fixed `away` from its estimate."""
        start = self._minimum.values + away * self._ridge
        fixed_value = float(self._minimum.values[self._place] + away)
        if not self._others:
            values = self._residuals([np.array([fixed_value])])[0]
            return math.inf if values is None else float(values @ values) - self._minimum.sum
        others = [self._parameters[k] for k in self._others]

        def residuals(points: Sequence[Array]) -> list[Array | None]:
            return self._residuals([np.insert(point, self._place, fixed_value) for point in points])

        low, high = bounds_of(others)
        try:
            least = minimise(residuals, others, np.clip(start[self._others], low, high))
        except ArithmeticError:
            return math.inf
        return least.sum - self._minimum.sum
