"""Stress over number of cycles to failure, and the sum of damage.

A curve is straight between its points on logarithmic axes. The packaged ones are for 1 % of
failures, from tables of life factors that are printed in open literature; they are starting values
for one's own test results, not the strength of a product.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Beyond = Literal["endless", "falls"]


class StressCurve(NamedTuple):
    """Stress that a number of cycles leads to failure (S-N curve, Woehler curve)."""

    cycles: tuple[float, ...]
    """Cycles to failure at the points of the curve, ascending."""
    stress: tuple[float, ...]
    """Stress at these points [Pa], descending."""
    beyond: Beyond = "falls"
    """After the last point: "falls" with the slope of the last part, or "endless" life."""

    def life(self, stress: ArrayLike) -> NDArray[np.float64]:
        """Cycles to failure.

        Args:
            stress: largest stress of each cycle [Pa], (...).

        Returns:
            Cycles, infinite where `beyond` is "endless" and for stress 0, (...).

        Raises:
            ValueError: a stress is negative, not finite, or above the first point: the curve says
                nothing of it.
        """
        given = np.asarray(stress, dtype=np.float64)
        wrong = given[~((given >= 0.0) & (given <= self.stress[0]))]
        if len(np.atleast_1d(wrong)):
            raise ValueError(
                f"stress = {wrong.flat[0]:.6g} Pa: must be within 0 and {self.stress[0]:.6g}, the "
                "first point of the curve"
            )
        places, numbers = np.log(self.stress), np.log(self.cycles)
        slopes = np.diff(numbers) / np.diff(places)
        with np.errstate(divide="ignore"):
            log_stress = np.log(given)
        part = np.searchsorted(-places, -log_stress, side="left").clip(1, len(slopes)) - 1
        with np.errstate(over="ignore"):
            life = np.exp(numbers[part] + slopes[part] * (log_stress - places[part]))
        if self.beyond == "endless":
            life = np.where(given < self.stress[-1], math.inf, life)
        return life

    def exponent(self, part: int = 0) -> float:
        """Exponent of a part of the curve: life is proportional to stress^-exponent there.

        Args:
            part: number of the part, from 0.

        Returns:
            The exponent on stress.
        """
        (n0, n1), (s0, s1) = self.cycles[part : part + 2], self.stress[part : part + 2]
        return math.log(n1 / n0) / math.log(s0 / s1)

    def damage(self, stress: ArrayLike, counts: ArrayLike) -> float:
        """Sum of damage after Palmgren (1924) and Miner (1945).

        Args:
            stress: largest stress of each kind of cycle [Pa], (n,).
            counts: how often each occurs, (n,).

        Returns:
            The sum of counts over lives; failure is expected at 1, in tests at 0.3 to 3.

        Raises:
            ValueError: see `life`, or a count is negative.
        """
        number = np.asarray(counts, dtype=np.float64)
        if (wrong := number[~(number >= 0.0)]).size:
            raise ValueError(f"counts = {wrong.flat[0]!r}: must be at least 0")
        return math.fsum(np.ravel(number / self.life(stress)))


class LifeFactors(NamedTuple):
    """Shape of a curve, in multiples of a strength."""

    cycles: tuple[float, ...]
    factor: tuple[float, ...]

    def curve(self, strength: float, beyond: Beyond = "falls") -> StressCurve:
        """The curve of a strength.

        Args:
            strength: stress at which the factor is 1 [Pa].
            beyond: see `StressCurve`; "endless" ends the curve where the factor is 1.

        Returns:
            The curve.

        Raises:
            ValueError: the strength is not above 0.
        """
        if not (math.isfinite(strength) and strength > 0.0):
            raise ValueError(f"strength = {strength!r} Pa: must be above 0")
        last = self.factor.index(1.0) + 1 if beyond == "endless" else len(self.factor)
        stress = tuple(strength * factor for factor in self.factor[:last])
        return StressCurve(self.cycles[:last], stress, beyond)


FLANK = {
    "case_hardened": LifeFactors((1e5, 5e7, 1e10), (1.6, 1.0, 0.85)),
    "through_hardened": LifeFactors((1e5, 5e7, 1e10), (1.6, 1.0, 0.85)),
}
"""Life factors of contact stress by class of material, no pitting permitted."""
ROOT = {
    "case_hardened": LifeFactors((1e3, 3e6, 1e10), (2.5, 1.0, 0.85)),
    "through_hardened": LifeFactors((1e4, 3e6, 1e10), (2.5, 1.0, 0.85)),
}
"""Life factors of root stress by class of material, for pulses from 0."""
