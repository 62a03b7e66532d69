"""How far a simulation is from the recording, in units of what noise makes of the means."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .readings import Array, Readings

CHANCE = 3.0  # standard deviations of a correlation of independent readings
LARGEST = 0.99  # correlation that is counted: of a drift, more of it is not known
EXACTNESS = 0.1  # of the tolerance: beyond what a mean over a stretch was seen to be off by


class Noise(NamedTuple):
    """Of one observable, whose sensors are the same throughout a stretch."""

    reading: Array
    """Standard deviation of one reading, shape (channels,)."""
    mean: Array
    """Standard deviation of the mean over a segment, shape (segments, channels)."""
    freedom: float
    """Degrees of freedom that it is known to; infinite where it was given."""
    correlation: float
    """Of successive readings, where it lowers what their mean tells; else 0."""


@dataclass(frozen=True)
class Yardstick:
    """The recorded means and their noise.

    Residuals are those of means over each operating point. Where teeth rattle, two runs that
    differ in the last bit soon differ in every interval, but not in their means.
    """

    recorded: tuple[Readings, ...]
    noise: tuple[Noise, ...]

    @property
    def freedom(self) -> float:
        """The fewest degrees of freedom that a noise is known to."""
        return min(noise.freedom for noise in self.noise)

    @property
    def count(self) -> int:
        """Of residuals."""
        return sum(noise.mean.size for noise in self.noise)

    def near(self, other: Yardstick, share: float) -> bool:
        """Whether no noise differs from another's by more than a `share` of it."""
        return all(
            bool(np.allclose(a.mean, b.mean, rtol=share, atol=0.0))
            for a, b in zip(self.noise, other.noise, strict=True)
        )

    def apart(self, readings: Sequence[Readings]) -> Array:
        """Differences of simulated means from the recorded ones over their noise, flat."""
        return np.concatenate(
            [
                ((_means(s) - _means(r)) / noise.mean).ravel()
                for s, r, noise in zip(readings, self.recorded, self.noise, strict=True)
            ]
        )


def measure_noise(
    recorded: Sequence[Readings],
    readings: Sequence[Readings],
    tolerance: float,
    given: Mapping[str, float],
) -> Yardstick:
    """The noise of `recorded`, from what is left of it beside a simulation, or as it is `given`.

    What repeats itself in both, as a cycle of the motor's torque does, is no noise.
    """
    noise = tuple(
        _noise(r, s, tolerance, given.get(r.name)) for r, s in zip(recorded, readings, strict=True)
    )
    return Yardstick(tuple(recorded), noise)


def _noise(recorded: Readings, readings: Readings, tolerance: float, given: float | None) -> Noise:
    rows = min(len(recorded.values), len(readings.values))
    left = recorded.values[:rows] - readings.values[:rows]
    segments, place, count = np.unique(
        recorded.segment[:rows], return_inverse=True, return_counts=True
    )
    means = _means(recorded)
    for s in range(len(segments)):
        left[place == s] -= left[place == s].mean(axis=0)
    scatter, size, repeat = np.empty(left.shape[1]), np.empty(means.shape), np.empty(left.shape[1])
    freedom = math.inf
    for kind in np.unique(recorded.kinds):
        alike = recorded.kinds == kind
        repeat[alike] = _correlation(left[:, alike], place)
        degrees = (rows - len(segments)) * int(alike.sum())
        freedom = min(freedom, degrees / _repeats(repeat[alike][0]))
        scatter[alike] = math.sqrt((left[:, alike] ** 2).sum() / degrees)
        size[:, alike] = np.abs(means[:, alike]).max(axis=1, keepdims=True)
    if given is not None:
        scatter[:], freedom = given, math.inf
    sampling = scatter * np.sqrt(_repeats(repeat) / count[:, None])
    floor = EXACTNESS * tolerance * size
    correlation = float(repeat.max(initial=0.0, where=(sampling > floor).any(axis=0)))
    return Noise(scatter, np.hypot(sampling, floor), freedom, correlation)


def _correlation(left: Array, place: NDArray[np.int64]) -> float:
    """Of `left` (readings, channels), each with the next of its segment; 0 if it may be chance."""
    same = place[1:] == place[:-1]
    products = (left[1:] * left[:-1])[same]
    square = float((left**2).sum())
    if square == 0.0 or not products.size:
        return 0.0
    found = float(products.sum()) / square * left.size / products.size
    return min(found, LARGEST) if found > CHANCE / math.sqrt(products.size) else 0.0


def _repeats(correlation: Any) -> Any:
    """Readings that tell as much as one independent one, of a process whose correlation falls off
    by this factor from one to the next (Bartlett 1946, J. R. Stat. Soc. Suppl. 8, 27-41)."""
    return (1.0 + correlation) / (1.0 - correlation)


def _means(readings: Readings) -> Array:
    """Over each segment, shape (segments, channels)."""
    segments = np.unique(readings.segment)
    return np.array([readings.values[readings.segment == s].mean(axis=0) for s in segments])
