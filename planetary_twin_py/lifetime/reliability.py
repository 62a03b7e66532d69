"""Probability that parts and whole gearboxes survive a damage or a time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..scene import Scene

Array = NDArray[np.float64]


ROUNDING = 1e-9  # relative, of a quantile


class Scatter(NamedTuple):
    """Shape of the scatter of lives around a calculated life."""

    slope: float
    """Weibull exponent b."""
    free: float
    """f_tB: time without failures over the life that 10 % do not reach."""
    failures: float
    """Share of failures at a damage of 1."""

    def weibull(self, life: float = 1.0) -> Weibull:
        """Distribution of the lives.

        Args:
            life: at a damage of 1, in any unit; 1: of the damage at which a part fails.

        Returns:
            The three-parameter Weibull distribution through this life (Bertsche and Lechner 2004).
        """
        tenth = (-math.log1p(-0.1)) ** (1.0 / self.slope)
        given = (-math.log1p(-self.failures)) ** (1.0 / self.slope)
        ten = life / (self.free + (1.0 - self.free) * given / tenth)
        location = self.free * ten
        return Weibull(self.slope, location, location + (ten - location) / tenth)


class Weibull(NamedTuple):
    """Three-parameter Weibull distribution, R = exp(-((t - t0)/(T - t0))^b)."""

    slope: float
    """b"""
    location: float
    """t0, before which nothing fails."""
    scale: float
    """T, characteristic life, which 63.2 % do not reach."""

    def reliability(self, time: ArrayLike) -> Array:
        """Share that survives.

        Args:
            time: in the unit of the location, (...).
        """
        return np.asarray(np.exp(-self.hazard(time)))

    def hazard(self, time: ArrayLike) -> Array:
        """Cumulative hazard, -ln R.

        Args:
            time: in the unit of the location, (...).
        """
        beyond = np.maximum(np.asarray(time, dtype=np.float64) - self.location, 0.0)
        return np.asarray((beyond / (self.scale - self.location)) ** self.slope)

    def quantile(self, failures: ArrayLike) -> Array:
        """Time that a share does not reach.

        Args:
            failures: the share, below 1, (...).
        """
        return self.beyond(0.0, failures)

    def beyond(self, reached: float, failures: ArrayLike) -> Array:
        """Time that a share of those that have reached another time does not reach.

        Args:
            reached: that time.
            failures: the share, below 1, (...).
        """
        more = np.maximum(-np.log1p(-np.asarray(failures, dtype=np.float64)), 0.0)
        width = self.scale - self.location
        time = self.location + width * (self.hazard(reached) + more) ** (1.0 / self.slope)
        return np.asarray(np.maximum(time, reached))


FLANK = Scatter(1.3, 0.6, 0.01)
"""Pitting."""
ROOT = Scatter(1.7, 0.875, 0.01)
"""Tooth breakage."""
SHAFT = Scatter(1.5, 0.8, 0.01)
"""Fatigue fracture of shafts: the middle of the ranges 1.1 to 1.9 and 0.7 to 0.95."""
BEARINGS = {"ball": Scatter(10.0 / 9.0, 0.0, 0.1), "roller": Scatter(9.0 / 8.0, 0.0, 0.1)}
"""Rolling bearings by their elements: two parameters (Lundberg and Palmgren 1947, 1952), as the
rating life L10 is that of 10 % failures."""


def scatter_of(scene: Scene, part: str) -> Scatter:
    """Scatter of the lives of a part.

    Gears as in the reliability of KISSsoft 03/2017 after Bertsche and Lechner.

    Args:
        scene: the gearbox, whose bearings have balls or rollers.
        part: name of the part, see `durability.parts`.
    """
    if part.endswith("_bearing"):
        assert scene.durability is not None
        rated = getattr(scene.durability.bearings, part.split("_")[0])
        return BEARINGS[rated.kind]
    if part.endswith("_shaft"):
        return SHAFT
    return ROOT if part.endswith("_root") else FLANK


def system_reliability(
    parts: Sequence[Weibull], time: float, ages: Sequence[float] | None = None
) -> float:
    """Share of gearboxes in which no part fails: a series system.

    Args:
        parts: lives of the parts.
        time: from now, in their unit.
        ages: of the parts, none of which has failed until now; None: all are new.
    """
    ages = ages or [0.0] * len(parts)
    return float(
        np.prod(
            [
                np.exp(part.hazard(age) - part.hazard(age + time))
                for part, age in zip(parts, ages, strict=True)
            ]
        )
    )


def system_quantile(
    parts: Sequence[Weibull], failures: float, ages: Sequence[float] | None = None
) -> float:
    """Time that a share of gearboxes does not reach.

    Args:
        parts: lives of the parts.
        failures: the share, within 0 and 1.
        ages: see `system_reliability`.

    Returns:
        The time from now, in their unit; infinite without parts.
    """
    if not parts:
        return math.inf
    from scipy.optimize import brentq

    ages = ages or [0.0] * len(parts)
    each = list(zip(parts, ages, strict=True))
    alone = min(float(part.beyond(age, failures)) - age for part, age in each)
    low = max(min(part.location - age for part, age in each), 0.0)

    def beyond(time: float) -> float:
        return 1.0 - system_reliability(parts, time, ages) - failures

    # Where one part decides, the quantile is its own, up to rounding.
    return float(brentq(beyond, low, alone * (1.0 + ROUNDING), xtol=ROUNDING * alone))
