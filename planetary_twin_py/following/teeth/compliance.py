"""Compliance and backlash: regression of the mean transmission error on torque and speed.

    TE = z + c T + B s + d w,   s = sign(T)

z is the zero of both encoders, c the compliance, and d the delay between both channels; a backlash
of all meshes shifts the error by the same amount, to the side of the torque. Compliance and
backlash may change after the baseline, z and d do not. So a change of the backlash is one of the
error at no torque, which is as certain as the load has varied widely.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..balance.variety import TORQUES
from ..estimate import Estimate, Status, estimated, not_identifiable

Array = NDArray[np.float64]

FEWEST = 8  # hunting periods of a regression
RECENT = 32  # hunting periods of the present regression
LARGEST_SD = 0.05  # relative standard deviation of a slope that is reported
RANK = 1e-9  # singular values below, over the largest, are round-off
DETERMINED = 1e-6  # share of a coefficient that rows may leave undetermined
OUTLYING = 6.0  # robust standard deviations of a hunting period in which something has changed
NORMAL = 1.4826  # standard deviation of a normal distribution over its median absolute deviation
REMEDY = "a load that varies by some percent"
CHANGES = ("compliance_change", ""), ("backlash_change", "m")  # since the baseline


class Line(NamedTuple):
    """Slope of the transmission error over the torque."""

    slope: float
    """[m/(N m)]."""
    sd: float
    """Its standard deviation [m/(N m)]."""

    @property
    def significant(self) -> bool:
        """Whether the torque has varied enough to determine the slope."""
        return self.sd < LARGEST_SD * abs(self.slope)


class Fit(NamedTuple):
    """Coefficients of a linear regression."""

    value: Array
    """Coefficients, (k,)."""
    covariance: Array
    """Their covariance, (k, k); infinite variances where the rows do not determine them."""

    def line(self, place: int) -> Line:
        """The coefficient at an index as a slope."""
        return Line(float(self.value[place]), math.sqrt(float(self.covariance[place, place])))


def fit(columns: Sequence[Array], error: Array) -> Fit | None:
    """Fit coefficients of columns, (n,), to errors [m], (n,); None for too few rows.

    Rows in which something has changed are left out.
    """
    if len(error) < FEWEST:
        return None
    rows = np.column_stack(columns)
    scales = np.sqrt(np.mean(rows**2, axis=0))
    scales[scales == 0.0] = 1.0
    rows = rows / scales
    kept = np.ones(len(error), dtype=bool)
    for _ in range(3):
        if kept.sum() < FEWEST:
            return None
        left, sizes, right = np.linalg.svd(rows[kept], full_matrices=False)
        rank = int(np.sum(sizes > RANK * sizes[0]))
        right = right[:rank] / sizes[:rank, np.newaxis]
        solution = right.T @ (left[:, :rank].T @ error[kept])
        residual = error - rows @ solution
        usual = NORMAL * float(np.median(np.abs(residual[kept])))
        kept_before, kept = kept, np.abs(residual) <= OUTLYING * usual
        if np.array_equal(kept, kept_before) or usual == 0.0:
            break
    variance = float(residual[kept_before] @ residual[kept_before])
    variance /= max(int(kept_before.sum()) - rank, 1)
    covariance = variance * (right.T @ right) / np.outer(scales, scales)
    free = np.sum((right * sizes[:rank, np.newaxis]) ** 2, axis=0) < 1.0 - DETERMINED
    covariance[free, free] = math.inf
    return Fit(solution / scales, covariance)


@dataclass
class Compliance:
    """Regressions over the first and the last blocks, within a segment of the encoders."""

    learning: int
    _segment: int = 0
    _blocks: list[tuple[float, float, float]] = field(default_factory=list)

    def add(self, segment: int, torque: float, speed: float, error: float) -> None:
        """Add a block: mean input torque [N m], speed [rad/s] and transmission error [m]."""
        if not (math.isfinite(torque) and math.isfinite(error)):
            return
        if segment != self._segment:
            self._segment = segment
            self._blocks.clear()
        self._blocks.append((torque, speed, error))
        if len(self._blocks) > self.learning + RECENT:
            del self._blocks[self.learning]

    @property
    def first(self) -> Array:
        """Torque, speed and error of the first blocks, (n, 3)."""
        return np.array(self._blocks[: self.learning], dtype=float).reshape(-1, 3)

    @property
    def present(self) -> Line | None:
        """Slope over the last blocks, or over all while there are few."""
        later = self._has_later
        torque, speed, error = self._columns(self.learning if later else 0)
        found = fit([np.ones_like(torque), torque, np.sign(torque), speed], error)
        return None if found is None else found.line(1)

    def estimates(self, per_input: float) -> tuple[Estimate, ...]:
        """Compliance, and changes of compliance and backlash since the baseline.

        `per_input` is the turn of the input per transmission error [rad/m].
        """
        present = self.present
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
        return compliance, *self._changes()

    def _changes(self) -> tuple[Estimate, ...]:
        """Changes of compliance and backlash since the baseline."""
        torque, speed, error = self._columns(0)
        later, one = np.arange(len(torque)) >= self.learning, np.ones_like(torque)
        side = np.sign(torque)
        both = [one, torque * ~later, torque * later, side, side * later, speed]
        found = fit(both, error) if self._has_later else None
        first, last = (None, None) if found is None else (found.line(1), found.line(2))
        if found is None or first is None or last is None:
            return _unknown("LEARNING")
        if not (first.significant and last.significant):
            return _unknown("NOT_IDENTIFIABLE")
        ratio, slopes = last.slope / first.slope, found.covariance[1:3, 1:3]
        weight = np.array([-ratio, 1.0]) / first.slope
        change_sd = math.sqrt(float(weight @ slopes @ weight))
        play = found.line(4)
        return (
            estimated("compliance_change", ratio - 1.0, change_sd, ""),
            estimated(
                "backlash_change", math.copysign(play.slope, play.slope * last.slope), play.sd,
                "m", TORQUES,
            ),
        )  # fmt: skip

    @property
    def _has_later(self) -> bool:
        """Whether there are enough blocks after those of the baseline."""
        return len(self._blocks) - self.learning >= FEWEST

    def _columns(self, begin: int) -> Array:
        """Torque, speed about its mean, and error of the blocks from an index on, (3, n)."""
        columns = np.array(self._blocks[begin:], dtype=float).reshape(-1, 3).T
        if columns.size:
            columns[1] -= columns[1].mean()
        return columns


def _unknown(status: Status) -> tuple[Estimate, ...]:
    """Changes that the blocks do not determine."""
    return tuple(not_identifiable(name, math.nan, unit, REMEDY, status) for name, unit in CHANGES)
