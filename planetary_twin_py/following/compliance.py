"""Compliance and backlash: regression of the mean transmission error on torque and speed.

A delay between the two encoders shifts the error in proportion to the speed, so the speed is a
regressor, too.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from .estimate import Estimate, Status, estimated, not_identifiable

FEWEST = 8  # hunting periods of a regression
RECENT = 32  # hunting periods of the present regression
LARGEST_SD = 0.05  # relative standard deviation of a slope that is reported
REMEDY = "a load that varies by some percent"
CHANGES = ("compliance_change", ""), ("backlash_change", "m")  # since the baseline


class Line(NamedTuple):
    """Regression plane of the transmission error over torque and speed."""

    slope: float
    """Slope over the torque [m/(N m)]."""
    sd: float
    """Its standard deviation [m/(N m)]."""
    coefficients: np.ndarray
    """Mean error [m], slope [m/(N m)], and slope over the speed [m s/rad]."""
    covariance: np.ndarray
    """Covariance of the coefficients, (3, 3)."""
    centre: tuple[float, float]
    """Mean torque [N m] and speed [rad/s]."""

    @property
    def significant(self) -> bool:
        """Whether the torque has varied enough to determine the slope."""
        return self.sd < LARGEST_SD * abs(self.slope)

    def at(self, torque: float, speed: float) -> tuple[float, float]:
        """Transmission error at an operating point.

        Args:
            torque: input torque [N m].
            speed: input speed [rad/s].

        Returns:
            Transmission error and its standard deviation [m].
        """
        row = np.array([1.0, torque - self.centre[0], speed - self.centre[1]])
        return float(row @ self.coefficients), math.sqrt(float(row @ self.covariance @ row))


def fit_line(torque: np.ndarray, speed: np.ndarray, error: np.ndarray) -> Line | None:
    """Fit a plane by least squares.

    Args:
        torque: mean input torques of the blocks [N m], (n,).
        speed: mean input speeds of the blocks [rad/s], (n,).
        error: mean transmission errors of the blocks [m], (n,).

    Returns:
        The plane; None if there are too few blocks, or if the torque is constant or a function of
        the speed.
    """
    n = len(torque)
    if n < FEWEST:
        return None
    centre = float(torque.mean()), float(speed.mean())
    rows = np.column_stack([np.ones(n), torque - centre[0], speed - centre[1]])
    scales = np.maximum(np.sqrt(np.mean(rows**2, axis=0)), 1e-300)
    scaled = rows / scales
    normal_matrix = scaled.T @ scaled
    if np.linalg.cond(normal_matrix[:2, :2]) > 1e12:
        return None
    inverse = np.linalg.pinv(normal_matrix, rcond=1e-9, hermitian=True)
    solution = inverse @ (scaled.T @ error)
    residuals = error - scaled @ solution
    variance = float(residuals @ residuals) / (n - 3)
    covariance = variance * inverse / np.outer(scales, scales)
    coefficients = solution / scales
    return Line(
        float(coefficients[1]), math.sqrt(float(covariance[1, 1])), coefficients, covariance, centre
    )


@dataclass
class Compliance:
    """Regressions over the first and the last blocks, within a segment of the encoders.

    Args:
        learning: number of first blocks.
    """

    learning: int
    _segment: int = 0
    _blocks: list[tuple[float, float, float]] = field(default_factory=list)

    def add(self, segment: int, torque: float, speed: float, error: float) -> None:
        """Add a block.

        Args:
            segment: number of times that the encoders have lost the count of turns.
            torque: mean input torque [N m].
            speed: mean input speed [rad/s].
            error: mean transmission error [m].
        """
        if not (math.isfinite(torque) and math.isfinite(error)):
            return
        if segment != self._segment:
            self._segment = segment
            self._blocks.clear()
        self._blocks.append((torque, speed, error))
        if len(self._blocks) > self.learning + RECENT:
            del self._blocks[self.learning]

    @property
    def first(self) -> np.ndarray:
        """Torque, speed and error of the first blocks, (n, 3)."""
        return np.array(self._blocks[: self.learning], dtype=float).reshape(-1, 3)

    @property
    def baseline(self) -> Line | None:
        """Regression over the first blocks."""
        return self._line(0, self.learning) if len(self._blocks) >= self.learning else None

    @property
    def present(self) -> Line | None:
        """Regression over the last blocks, or over all while there are few."""
        later = len(self._blocks) - self.learning
        return self._line(self.learning if later >= FEWEST else 0, None)

    @property
    def both(self) -> tuple[Line, Line] | None:
        """Baseline and present regression, if they have no block in common."""
        first, last = self.baseline, self.present
        if first is None or last is None or len(self._blocks) - self.learning < FEWEST:
            return None
        return first, last

    def estimates(self, per_input: float) -> tuple[Estimate, ...]:
        """Compliance, and changes of compliance and backlash since the baseline.

        Args:
            per_input: turn of the input per transmission error [rad/m].
        """
        present, both = self.present, self.both
        if present is None:
            remedy = "hunting periods with the torque measured"
            return tuple(
                not_identifiable(name, math.nan, unit, remedy, "LEARNING")
                for name, unit in (("compliance", "rad/(N m)"), *CHANGES)
            )
        slope, sd = abs(present.slope) * per_input, present.sd * per_input
        compliance = (
            estimated("compliance", slope, sd, "rad/(N m)", REMEDY)
            if present.significant
            else not_identifiable("compliance", sd, "rad/(N m)", REMEDY)
        )
        if both is None or not (both[0].significant and both[1].significant):
            status: Status = "LEARNING" if both is None else "NOT_IDENTIFIABLE"
            unknown = (
                not_identifiable(name, math.nan, unit, REMEDY, status) for name, unit in CHANGES
            )
            return compliance, *unknown
        return compliance, *_changes(*both)

    def _line(self, begin: int, end: int | None) -> Line | None:
        blocks = np.array(self._blocks[begin:end]).reshape(-1, 3)
        return fit_line(*blocks.T)


def _changes(first: Line, last: Line) -> tuple[Estimate, Estimate]:
    """Changes of compliance and backlash between two regressions."""
    change = last.slope / first.slope - 1.0
    change_sd = math.hypot(last.sd, first.sd) / abs(first.slope)
    last_error, last_sd = last.at(*last.centre)
    first_error, first_sd = first.at(*last.centre)
    return (
        estimated("compliance_change", change, change_sd, ""),
        estimated(
            "backlash_change",
            2.0 * (last_error - first_error),
            2.0 * math.hypot(last_sd, first_sd),
            "m",
        ),
    )
