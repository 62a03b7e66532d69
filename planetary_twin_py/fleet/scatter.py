"""Measures how much the torque balance of each gearbox scatters, from its first balances.

Rows that are instants of a wandering speed contain an inertia torque of which the difference of two
speeds shows only a part. So do rounded speeds. The residuals of the scene's balance then scatter by
more than the noise of the sensors explains.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.special import chdtri

from ..following.balance.balances import Balances
from ..following.balance.filter import GATE

Array = NDArray[np.float64]

BALANCES, FEWEST = 20, 5  # of a gearbox, from which its scatter is measured; fewest at the end
APART = 5.0  # [s] between two of them at least, so that they do not share one swing of the speed
GAIN = 0.2  # largest error of a gain; no more of a balance is explained by its torque
FITTED = 2  # parameters: a constant and a gain
RARE = 1e-4  # probability with which noise as stated seems to scatter by more
MAD = 1.4826  # standard deviation over the median absolute deviation of normal values


class Scatter:
    """Scatter of the balances of many gearboxes."""

    def __init__(self, count: int) -> None:
        self.sd = np.full(count, math.nan)
        """Measured standard deviation of a balance [N m], (n,); NaN before it is known."""
        self.stated = np.full(count, math.nan)
        """The same as the noise of the sensors explains it [N m], (n,)."""
        self.excessive = np.zeros(count, dtype=bool)
        """Whether the noise of the sensors does not explain the scatter, (n,)."""
        self._kept = np.full((3, BALANCES, count), math.nan)
        """Residuals with the scene, torques [N m], and variances as the sensors explain them."""
        self._number = np.zeros(count, dtype=np.int64)
        self._next = np.full(count, -math.inf)  # [s]

    @property
    def known(self) -> NDArray[np.bool_]:
        """Whether the scatter of a gearbox has been measured, (n,)."""
        return np.isfinite(self.sd)

    def add(self, time: float, balances: Balances) -> NDArray[np.bool_]:
        """Add balances with the parameters of the scene, (n,); return whose scatter is large."""
        taken = np.isfinite(balances.value) & (time >= self._next) & (self._number < BALANCES)
        (gearbox,) = np.nonzero(taken)
        values = np.array([balances.value, balances.torque, balances.sd**2])
        self._kept[:, self._number[gearbox], gearbox] = values[:, gearbox]
        self._number[gearbox] += 1
        self._next[gearbox] = time + APART
        return self._measure(taken & (self._number == BALANCES))

    def finish(self) -> NDArray[np.bool_]:
        """Measure gearboxes with few balances, at the end; return whose scatter is excessive."""
        return self._measure(~self.known & (self._number >= FEWEST))

    def _measure(self, which: NDArray[np.bool_]) -> NDArray[np.bool_]:
        found = np.zeros_like(which)
        for n in np.flatnonzero(which):
            residual, torque, noise = self._kept[:, : self._number[n], n]
            stated = float(np.mean(noise))
            variance, freedom = _variance(residual, torque, stated)
            self.sd[n], self.stated[n] = math.sqrt(variance), math.sqrt(stated)
            found[n] = variance > stated * float(chdtri(freedom, RARE)) / freedom
        self.excessive |= found
        return found


def _variance(residual: Array, torque: Array, stated: float) -> tuple[float, int]:
    """Variance of the residuals of one gearbox, and its degrees of freedom.

    A constant and a gain are fitted. As the noise of a balance is also in its torque, the gain is
    limited: with a steady torque, a larger one would explain all scatter. Single wild residuals, as
    the filter rejects them, do not count.
    """
    far = np.abs(residual - np.median(residual))
    kept = far <= GATE * max(MAD * float(np.median(far)), math.sqrt(stated))
    residual, torque = (v[kept] - np.mean(v[kept]) for v in (residual, torque))
    square = float(torque @ torque)
    gain = np.clip(residual @ torque / square, -GAIN, GAIN) if square > 0.0 else 0.0
    left = residual - gain * torque
    freedom = len(left) - FITTED
    return float(left @ left) / freedom, freedom
