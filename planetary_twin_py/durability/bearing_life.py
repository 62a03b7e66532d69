"""Basic and modified rating life of rolling bearings (ISO 281:2007)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..text.number_check import check_number

Elements = Literal["ball", "roller"]
MILLION = 1e6  # turns to which the rating refers
MOST = 50.0  # of the factor for lubrication and contamination
LEAST_RATIO, LARGEST_RATIO = 0.1, 4.0  # of the viscosities for which the factor is given


class _Curve(NamedTuple):
    """Constants of the factor (ISO 281:2007, eq. 31 to 36): up to a ratio, kappa."""

    up_to: float
    factor: float
    power: float


class _Kind(NamedTuple):
    life: float  # exponent of the basic rating life
    base: float
    inner: float  # exponent of the bracket with kappa
    load: float  # exponent of e_C C_u/P
    outer: float
    curves: Sequence[_Curve]


_KINDS: dict[Elements, _Kind] = {
    "ball": _Kind(
        3.0, 2.5671, 0.83, 1.0 / 3.0, -9.3,
        [_Curve(0.4, 2.2649, 0.054381), _Curve(1.0, 1.9987, 0.19087),
         _Curve(4.0, 1.9987, 0.071739)],
    ),
    "roller": _Kind(
        10.0 / 3.0, 1.5859, 1.0, 0.4, -9.185,
        [_Curve(0.4, 1.3993, 0.054381), _Curve(1.0, 1.2348, 0.19087),
         _Curve(4.0, 1.2348, 0.071739)],
    ),
}  # fmt: skip


def exponent_of(elements: Elements) -> float:
    """Exponent p of load in the life: 3 for balls, 10/3 for rollers."""
    return _KINDS[elements].life


class RatedBearing(NamedTuple):
    """A rolling bearing, or several on one seat."""

    rating: float
    """Basic dynamic load rating C of one bearing [N]."""
    elements: Elements
    """Kind of its rolling elements."""
    number: int = 1
    """Bearings that share the load evenly; lives are those of each of them."""

    @property
    def exponent(self) -> float:
        """Exponent p of load in the life: 3 for balls, 10/3 for rollers."""
        return exponent_of(self.elements)

    def life(self, load: float) -> float:
        """Basic rating life L10, which 90 % of such bearings reach [turns].

        Args:
            load: equivalent dynamic load P on all of them [N].

        Raises:
            ValueError: the load is negative or not finite.
        """
        return math.inf if load == 0.0 else MILLION / self._per_million(load)

    def _per_million(self, load: float) -> float:
        check_number("load", load, "N")
        if not (math.isfinite(load) and load >= 0.0):
            raise ValueError(f"load = {load!r} N: must be at least 0 and finite")
        return float((load / (self.number * self.rating)) ** self.exponent)

    def damage(self, loads: ArrayLike, turns: ArrayLike) -> float:
        """Sum of turns over lives, 1 at the basic rating life (Palmgren 1924).

        Args:
            loads: equivalent loads [N], (n,).
            turns: turns under each, of the inner race relative to the outer one, (n,).

        Returns:
            The sum.

        Raises:
            ValueError: a load or a number of turns is negative or not finite.
        """
        counts = np.broadcast_to(np.asarray(turns, dtype=np.float64), np.shape(loads))
        if (wrong := counts[~((counts >= 0.0) & np.isfinite(counts))]).size:
            raise ValueError(f"turns = {wrong.flat[0]!r}: must be at least 0 and finite")
        values = np.atleast_1d(np.asarray(loads, dtype=np.float64)).ravel()
        shares = [self._per_million(float(load)) for load in values]
        return math.fsum(n * share / MILLION for n, share in zip(counts.flat, shares, strict=True))

    def modification(self, load: float, ratio: float, cleanliness: float, limit: float) -> float:
        """Factor a_ISO of the life for lubrication and contamination.

        Args:
            load: equivalent dynamic load on all of them [N].
            ratio: kappa, viscosity of the oil over that which the bearing wants; from 0.1; above 4
                it counts as 4.
            cleanliness: e_C of the oil, from 0 (very dirty) to 1 (clean).
            limit: fatigue load limit C_u of one bearing [N].

        Returns:
            The factor, at most 50 (ISO 281:2007, eq. 31 to 36).

        Raises:
            ValueError: an argument is out of range.
        """
        if not ratio >= LEAST_RATIO:
            raise ValueError(f"ratio = {ratio!r}: must be at least {LEAST_RATIO:g}")
        if not 0.0 <= cleanliness <= 1.0:
            raise ValueError(f"cleanliness = {cleanliness!r}: must be within 0 and 1")
        for name, value in (("load", load), ("limit", limit)):
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{name} = {value!r} N: must be above 0 and finite")
        kind, kappa = _KINDS[self.elements], min(ratio, LARGEST_RATIO)
        curve = next(each for each in kind.curves if kappa <= each.up_to)
        lubrication = (kind.base - curve.factor / kappa**curve.power) ** kind.inner
        left = 1.0 - lubrication * (cleanliness * self.number * limit / load) ** kind.load
        return MOST if left <= 0.0 else min(MOST, 0.1 * float(left**kind.outer))
