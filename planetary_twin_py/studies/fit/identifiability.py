"""Parameters that the readings do not determine, from the sensitivities at the minimum."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .least_squares import Array, Minimum, Residuals
from .parameter import Parameter

PART = 0.3  # component of a unit direction above which a parameter belongs to it
WIDER = 4.0  # ratio of successive steps of the search
FARTHEST = 10  # steps of the search on each side


@dataclass(frozen=True)
class LinearAnalysis:
    """Identifiable and non-identifiable directions of the model linearised at a minimum."""

    covariance: Array
    """Covariance of the parameters (p, p) in the identifiable directions."""
    groups: tuple[tuple[int, ...], ...]
    """Indices of the parameters of each direction that is not identifiable."""

    def identifiable(self, place: int) -> bool:
        """Whether the parameter with this index is in none of the groups."""
        return all(place not in members for members in self.groups)


def split(minimum: Minimum, parameters: Sequence[Parameter], quantile: float) -> LinearAnalysis:
    """Split the parameter space into identifiable and non-identifiable directions.

    A singular value of the scaled sensitivities is the change of the readings, in standard
    deviations of the noise, for a change of the parameters by their own magnitude. A direction is
    not identifiable below the singular value `quantile`.
    """
    size = magnitudes(minimum, parameters)
    _, strength, directions = np.linalg.svd(minimum.slopes * size, full_matrices=False)
    identifiable = strength > quantile
    known = directions[identifiable] / strength[identifiable, None]
    covariance = (known.T @ known) * np.outer(size, size)
    groups = tuple(
        tuple(np.flatnonzero(np.abs(v) > PART).tolist()) for v in directions[~identifiable]
    )
    return LinearAnalysis(covariance, groups)


def magnitudes(minimum: Minimum, parameters: Sequence[Parameter]) -> Array:
    """Magnitudes (p,) that scale changes of the parameters."""
    return np.maximum(np.abs(minimum.values), [0.1 * p.scale for p in parameters])


def insensitive_range(
    residuals: Residuals,
    parameters: Sequence[Parameter],
    minimum: Minimum,
    place: int,
    rise: float,
) -> tuple[float, float]:
    """Range of one parameter, the others fixed, in which the sum of squares is insensitive to it.

    The ends are the lowest and the highest value tried whose increase is below `rise`.
    """
    parameter, centre = parameters[place], float(minimum.values[place])
    ends = []
    for sign, bound in ((-1.0, parameter.low), (1.0, parameter.high)):
        tried = _towards(centre, bound, sign * parameter.scale)
        points = [minimum.values.copy() for _ in tried]
        for point, value in zip(points, tried, strict=True):
            point[place] = value
        end = centre
        for value, trial_residuals in zip(tried, residuals(points), strict=True):
            if (
                trial_residuals is None
                or float(trial_residuals @ trial_residuals) - minimum.sum > rise
            ):
                break
            end = value
        ends.append(end)
    return ends[0], ends[1]


def _towards(centre: float, bound: float, step: float) -> list[float]:
    """Values at increasing distance from `centre`, then `bound` if it is finite."""
    values = centre + step * WIDER ** np.arange(FARTHEST)
    within = values[(bound - values) * step > 0.0].tolist()
    return within + ([bound] if math.isfinite(bound) and bound != centre else [])


def correlation(linear: LinearAnalysis) -> Array:
    """Correlation of the estimates (p, p); NaN for parameters that are not identifiable."""
    deviation = np.sqrt(np.diag(linear.covariance))
    deviation[[not linear.identifiable(k) for k in range(len(deviation))]] = math.nan
    return np.asarray(linear.covariance / np.outer(deviation, deviation))
