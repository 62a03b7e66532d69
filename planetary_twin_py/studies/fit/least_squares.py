"""Nonlinear least squares with several starts; residuals of many points are evaluated at once."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .parameter import Parameter

Array = NDArray[np.float64]
Residuals = Callable[[Sequence[Array]], list[Array | None]]
"""Residuals (m,), divided by their noise, at each of several points (p,); None where the simulation
fails."""

STEP = 5e-3
"""Relative step of finite differences: means over 0.3 s scatter by 3e-6 at tolerance 1e-3, so the
slopes have errors of 3e-4, and the truncation error of central differences is a fifth of that."""
FAR = 8.0  # largest ratio of other starts to the first start
STARTS = 6  # starts per parameter; the search uses the best
SEARCHES = 4
MISFIT = 1e-3  # probability below which noise does not explain the residuals
MOST_STEPS = 30
DECADES = 12  # decades searched for the magnitude of a parameter that starts at zero
NO_WORSE = 1.0  # increase of the sum of squares that is not significant
CLOSE = 1e-5  # relative change of the parameters at convergence
FLAT = 1e-6  # relative change of the sum of squares at convergence, far below its scatter


@dataclass(frozen=True)
class Minimum:
    """Values (p,), residuals (m,) and their slopes (m, p) at a minimum of the sum of squares."""

    values: Array
    residuals: Array
    slopes: Array

    @property
    def sum(self) -> float:
        """Sum of squares."""
        return float(self.residuals @ self.residuals)


def search(residuals: Residuals, parameters: Sequence[Parameter], seed: int = 0) -> Minimum:
    """Minimise the sum of squares from several starts, the best of them first.

    While noise does not explain the residuals, as on a plateau, the next start is the one farthest
    from the previous starts. Raises `ArithmeticError` if the residuals cannot be computed at any
    start.
    """
    starts = _starts(parameters, seed)
    sums = [_sum(start_residuals) for start_residuals in residuals(starts)]
    feasible = [start for start, total in zip(starts, sums, strict=True) if total < math.inf]
    if not feasible:
        raise ArithmeticError("the excerpt cannot be simulated at any start value")
    tried = [starts[int(np.argmin(sums))]]
    best = minimise(residuals, parameters, tried[0])
    while not explained(best) and len(tried) < min(SEARCHES, len(feasible)):
        tried.append(_farthest(feasible, tried, parameters))
        other = minimise(residuals, parameters, tried[-1])
        best = min(best, other, key=lambda minimum: minimum.sum)
    return best


def explained(minimum: Minimum) -> bool:
    """Whether noise explains the residuals at a minimum (chi-squared test)."""
    from scipy.stats import chi2

    left = len(minimum.residuals) - len(minimum.values)
    return bool(chi2.sf(minimum.sum, max(left, 1)) >= MISFIT)


def _sum(residuals: Array | None) -> float:
    return math.inf if residuals is None else float(residuals @ residuals)


def _farthest(
    starts: Sequence[Array], tried: Sequence[Array], parameters: Sequence[Parameter]
) -> Array:
    scale = np.array([p.scale for p in parameters])

    def distance(start: Array) -> float:
        differences = [np.arcsinh(start / scale) - np.arcsinh(other / scale) for other in tried]
        return min(float(difference @ difference) for difference in differences)

    return max(starts, key=distance)


def with_initial_magnitudes(
    residuals: Residuals, parameters: Sequence[Parameter]
) -> tuple[Parameter, ...]:
    """Replace a start of zero, if zero is the end of the range, by an order of magnitude.

    It is the largest of the decades of the range that fits no worse than the others, with the
    other parameters at their starts.
    """
    updated = list(parameters)
    for k, parameter in enumerate(parameters):
        if parameter.start != 0.0 or parameter.low != 0.0 or parameter.high == math.inf:
            continue
        tried = [parameter.high * 10.0**-n for n in range(1, DECADES + 1)]
        starts = [np.array([p.start for p in updated])]
        starts += [np.insert(np.delete(starts[0], k), k, value) for value in tried]
        sums = [_sum(start_residuals) for start_residuals in residuals(starts)]
        candidates = [
            trial
            for trial, total in zip(tried, sums[1:], strict=True)
            if total <= min(sums) + NO_WORSE
        ]
        updated[k] = parameter._replace(start=max(candidates, default=0.0))
    return tuple(updated)


def minimise(residuals: Residuals, parameters: Sequence[Parameter], start: Array) -> Minimum:
    """Local minimum of the sum of squares from `start`, (p,); all slopes are zero there."""
    from scipy.optimize import least_squares

    scale = np.array([p.scale for p in parameters])
    low, high = bounds_of(parameters)
    width = len(_residuals_at(residuals, start))

    def at(scaled: Array) -> Array:
        values = residuals([scaled * scale])[0]
        return np.full(width, math.inf) if values is None else values

    def slopes(scaled: Array) -> Array:
        return differentiate(residuals, parameters, scaled * scale) * scale

    clipped = np.clip(start, low, high)
    first_slopes = differentiate(residuals, parameters, clipped)
    if not first_slopes.any():  # `least_squares` would divide by them
        return Minimum(clipped, at(clipped / scale), first_slopes)
    solution = least_squares(
        at, clipped / scale, slopes, bounds=(low / scale, high / scale),
        xtol=CLOSE, ftol=FLAT, gtol=None, max_nfev=MOST_STEPS,
    )  # fmt: skip
    return Minimum(solution.x * scale, solution.fun, np.asarray(solution.jac) / scale)


def differentiate(residuals: Residuals, parameters: Sequence[Parameter], values: Array) -> Array:
    """Slopes (m, p) of the residuals by central differences, one-sided at a bound.

    Raises `ArithmeticError` if the residuals cannot be computed near `values`.
    """
    low, high = bounds_of(parameters)
    points, widths = [], []
    for k, parameter in enumerate(parameters):
        step = STEP * max(abs(values[k]), 0.1 * parameter.scale)
        ends = np.clip([values[k] - step, values[k] + step], low[k], high[k])
        widths.append(ends[1] - ends[0])
        for end in ends:
            point = values.copy()
            point[k] = end
            points.append(point)
    values_at_points = residuals(points)
    if any(point_values is None for point_values in values_at_points):
        raise ArithmeticError("the excerpt cannot be simulated near the estimated values")
    pairs = np.array(values_at_points).reshape(len(parameters), 2, -1)
    return np.asarray((pairs[:, 1] - pairs[:, 0]).T / widths)


def bounds_of(parameters: Sequence[Parameter]) -> tuple[Array, Array]:
    """Lower and upper bounds, (p,) each."""
    return np.array([p.low for p in parameters]), np.array([p.high for p in parameters])


def _starts(parameters: Sequence[Parameter], seed: int) -> list[Array]:
    """The given start, and others of different magnitude."""
    from scipy.stats.qmc import LatinHypercube

    first = np.array([p.start for p in parameters])
    size = np.array([math.copysign(p.scale, p.start) for p in parameters])
    shares = LatinHypercube(len(parameters), rng=seed).random(STARTS * len(parameters))
    others = size * FAR ** (2.0 * shares - 1.0)
    low, high = bounds_of(parameters)
    return [first, *np.clip(others, low, high)]


def _residuals_at(residuals: Residuals, point: Array) -> Array:
    values = residuals([point])[0]
    if values is None:
        raise ArithmeticError("the excerpt cannot be simulated at the start")
    return values
