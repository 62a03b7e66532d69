"""A high-pass filter of first order, which leaves the alternating part of a signal."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

Array = NDArray[np.float64]


class HighPass:
    """A high-pass filter of first order, as samples arrive.

    Args:
        cut_off: frequency at which 0.71 is left [Hz].
        rate: of the samples [Hz].
        start: constant values before the first sample, one for each column.
    """

    def __init__(self, cut_off: float, rate: float, start: Array) -> None:
        # y(n) = decay y(n - 1) + (1 + decay)/2 (x(n) - x(n - 1)): the bilinear transform
        self._decay = math.exp(-math.tau * cut_off / rate)
        self._gain = 0.5 * (1.0 + self._decay)
        self._state = -self._gain * np.asarray(start, dtype=np.float64)[None, :]

    def take(self, values: Array) -> Array:
        """Alternating part of the next samples, (samples, columns)."""
        numerator = np.array([self._gain, -self._gain])
        found, self._state = lfilter(numerator, [1.0, -self._decay], values, axis=0, zi=self._state)
        return np.asarray(found)
