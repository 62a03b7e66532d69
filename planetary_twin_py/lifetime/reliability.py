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
        beyond = np.maximum(np.asarray(time, dtype=np.float64) - self.location, 0.0)
        return np.asarray(np.exp(-((beyond / (self.scale - self.location)) ** self.slope)))

    def quantile(self, failures: ArrayLike) -> Array:
        """Time that a share does not reach.

        Args:
            failures: the share, below 1, (...).
        """
        hazard = np.maximum(-np.log1p(-np.asarray(failures, dtype=np.float64)), 0.0)
        width = self.scale - self.location
        return np.asarray(self.location + width * hazard ** (1.0 / self.slope))

    def beyond(self, reached: float, failures: ArrayLike) -> Array:
        """Time that a share of those that have reached another time does not reach.

        Args:
            reached: that time.
            failures: the share, below 1, (...).
        """
        survived = self.reliability(reached)
        share = np.asarray(failures, dtype=np.float64)
        return np.maximum(self.quantile(1.0 - survived * (1.0 - share)), reached)


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


def system_reliability(parts: Sequence[Weibull], time: float) -> float:
    """Share of gearboxes in which no part has failed: a series system.

    Args:
        parts: lives of the parts.
        time: in their unit.
    """
    return float(np.prod([part.reliability(time) for part in parts]))


def system_quantile(parts: Sequence[Weibull], failures: float) -> float:
    """Time that a share of gearboxes does not reach.

    Args:
        parts: lives of the parts.
        failures: the share, within 0 and 1.

    Returns:
        The time in their unit; infinite without parts.
    """
    if not parts:
        return math.inf
    from scipy.optimize import brentq

    alone = min(float(part.quantile(failures)) for part in parts)
    low = min(part.location for part in parts)

    def beyond(time: float) -> float:
        return 1.0 - system_reliability(parts, time) - failures

    # Where one part decides, the quantile is its own, up to rounding.
    return float(brentq(beyond, low, alone * (1.0 + ROUNDING), xtol=ROUNDING * alone))
