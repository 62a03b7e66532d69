"""What the readings do not tell, from how they change with the parameters."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .least_squares import Array, Minimum, Residuals
from .parameter import Parameter

PART = 0.3  # of a direction of unit length, from which a parameter is named as part of it
WIDER = 4.0  # from one value tried to the next
FARTHEST = 10  # values tried on each side


@dataclass(frozen=True)
class Told:
    """The linear picture at a minimum, split into what is told and what is not."""

    covariance: Array
    """Of the parameters (p, p), without the directions that are not told."""
    untold: tuple[tuple[int, ...], ...]
    """Parameters of each direction in which a change by their own magnitude is lost in noise."""

    def lost(self, place: int) -> bool:
        """Whether a parameter is part of what is not told."""
        return any(place in members for members in self.untold)


def split(minimum: Minimum, parameters: Sequence[Parameter], quantile: float) -> Told:
    """Directions of the parameters, relative to their magnitudes, by what they change.

    Singular values of the slopes are how many standard deviations of the noise a change of the
    whole magnitude makes; one below `quantile` is not told from none at all.
    """
    size = magnitudes(minimum, parameters)
    _, strength, directions = np.linalg.svd(minimum.slopes * size, full_matrices=False)
    seen = strength > quantile
    known = directions[seen] / strength[seen, None]
    covariance = (known.T @ known) * np.outer(size, size)
    lost = tuple(tuple(np.flatnonzero(np.abs(v) > PART).tolist()) for v in directions[~seen])
    return Told(covariance, lost)


def magnitudes(minimum: Minimum, parameters: Sequence[Parameter]) -> Array:
    """By which changes of the parameters (p,) are counted."""
    return np.maximum(np.abs(minimum.values), [0.1 * p.scale for p in parameters])


def unseen(
    residuals: Residuals,
    parameters: Sequence[Parameter],
    minimum: Minimum,
    place: int,
    rise: float,
) -> tuple[float, float]:
    """Lowest and highest value tried of one parameter that raise the sum of squares less."""
    parameter, centre = parameters[place], float(minimum.values[place])
    ends = []
    for sign, bound in ((-1.0, parameter.low), (1.0, parameter.high)):
        tried = _towards(centre, bound, sign * parameter.scale)
        points = [minimum.values.copy() for _ in tried]
        for point, value in zip(points, tried, strict=True):
            point[place] = value
        end = centre
        for value, there in zip(tried, residuals(points), strict=True):
            if there is None or float(there @ there) - minimum.sum > rise:
                break
            end = value
        ends.append(end)
    return ends[0], ends[1]


def _towards(centre: float, bound: float, step: float) -> list[float]:
    """Values ever farther from `centre`, and `bound` if it is finite and not there yet."""
    values = centre + step * WIDER ** np.arange(FARTHEST)
    within = values[(bound - values) * step > 0.0].tolist()
    return within + ([bound] if math.isfinite(bound) and bound != centre else [])


def correlation(told: Told) -> Array:
    """Of the estimates (p, p); NaN beside what is not told."""
    deviation = np.sqrt(np.diag(told.covariance))
    deviation[[told.lost(k) for k in range(len(deviation))]] = math.nan
    return np.asarray(told.covariance / np.outer(deviation, deviation))
