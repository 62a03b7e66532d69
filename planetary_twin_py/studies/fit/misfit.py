"""Residuals between simulation and recording, weighted by the noise of the means."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .readings import Array, Readings

CHANCE = 3.0  # significance level of a correlation, in standard deviations
LARGEST = 0.99  # upper limit of a correlation; a drift does not determine it better
EXACTNESS = 0.1  # numerical error of a mean, in tolerances; upper bound of observed errors


class Noise(NamedTuple):
    """Noise of one observable."""

    reading: Array
    """Standard deviation of one reading, shape (channels,)."""
    mean: Array
    """Standard deviation of the mean over a segment, shape (segments, channels)."""
    freedom: float
    """Degrees of freedom of the estimate; infinite if the noise is given."""
    correlation: float
    """Correlation of successive readings if it increases the noise of the mean; else 0."""


@dataclass(frozen=True)
class WeightedReadings:
    """Recorded means and their noise.

    Residuals are computed from means over each operating point: if teeth rattle chaotically, two
    runs with different rounding errors soon differ in every interval, but not in their means.
    """

    recorded: tuple[Readings, ...]
    noise: tuple[Noise, ...]

    @property
    def freedom(self) -> float:
        """Smallest number of degrees of freedom of any noise."""
        return min(noise.freedom for noise in self.noise)

    @property
    def count(self) -> int:
        """Number of residuals."""
        return sum(noise.mean.size for noise in self.noise)

    def near(self, other: WeightedReadings, share: float) -> bool:
        """Whether all noise agrees with that of `other` within the relative difference `share`."""
        return all(
            bool(np.allclose(a.mean, b.mean, rtol=share, atol=0.0))
            for a, b in zip(self.noise, other.noise, strict=True)
        )

    def residuals(self, readings: Sequence[Readings]) -> Array:
        """Simulated minus recorded means, divided by their noise, as a vector."""
        return np.concatenate(
            [
                ((means_of(s) - means_of(r)) / noise.mean).ravel()
                for s, r, noise in zip(readings, self.recorded, self.noise, strict=True)
            ]
        )


def measure_noise(
    recorded: Sequence[Readings],
    readings: Sequence[Readings],
    tolerance: float,
    given: Mapping[str, float],
) -> WeightedReadings:
    """Estimate the noise from the differences of recorded and simulated readings.

    Fluctuations that both have, such as torque ripple, do not count as noise. `given` are known
    standard deviations of a reading by observable, in SI.
    """
    noise = tuple(
        _noise(r, s, tolerance, given.get(r.name)) for r, s in zip(recorded, readings, strict=True)
    )
    return WeightedReadings(tuple(recorded), noise)


def _noise(recorded: Readings, readings: Readings, tolerance: float, given: float | None) -> Noise:
    rows = min(len(recorded.values), len(readings.values))
    differences = recorded.values[:rows] - readings.values[:rows]
    segments, segment_index, count = np.unique(
        recorded.segment[:rows], return_inverse=True, return_counts=True
    )
    means = means_of(recorded)
    for s in range(len(segments)):
        differences[segment_index == s] -= differences[segment_index == s].mean(axis=0)
    scatter, size, correlations = (
        np.empty(differences.shape[1]),
        np.empty(means.shape),
        np.empty(differences.shape[1]),
    )
    freedom = math.inf
    for kind in np.unique(recorded.kinds):
        same = recorded.kinds == kind
        correlations[same] = _correlation(differences[:, same], segment_index)
        degrees = (rows - len(segments)) * int(same.sum())
        freedom = min(freedom, degrees / _repeats(correlations[same][0]))
        scatter[same] = math.sqrt((differences[:, same] ** 2).sum() / degrees)
        size[:, same] = np.abs(means[:, same]).max(axis=1, keepdims=True)
    if given is not None:
        scatter[:], freedom = given, math.inf
    sampling = scatter * np.sqrt(_repeats(correlations) / count[:, None])
    floor = EXACTNESS * tolerance * size
    correlation = float(correlations.max(initial=0.0, where=(sampling > floor).any(axis=0)))
    return Noise(scatter, np.hypot(sampling, floor), freedom, correlation)


def _correlation(differences: Array, segment_index: NDArray[np.int64]) -> float:
    """Correlation of successive rows of `left` (readings, channels); 0 if not significant."""
    same = segment_index[1:] == segment_index[:-1]
    products = (differences[1:] * differences[:-1])[same]
    square = float((differences**2).sum())
    if square == 0.0 or not products.size:
        return 0.0
    coefficient = float(products.sum()) / square * differences.size / products.size
    return min(coefficient, LARGEST) if coefficient > CHANCE / math.sqrt(products.size) else 0.0


def _repeats(correlation: Any) -> Any:
    """Number of readings per independent reading, for a first-order autoregressive process
    (Bartlett 1946, J. R. Stat. Soc. Suppl. 8, 27-41)."""
    return (1.0 + correlation) / (1.0 - correlation)


def means_of(readings: Readings) -> Array:
    """Means over each operating point, (segments, channels)."""
    segments = np.unique(readings.segment)
    return np.array([readings.values[readings.segment == s].mean(axis=0) for s in segments])
