"""Statistics of samples that are not normally distributed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Self

import numpy as np


class Quantiles(NamedTuple):
    """Quantiles of a sample; NaN if it is empty."""

    p50: float
    p99: float
    max: float

    @classmethod
    def of(cls, values: Sequence[float]) -> Self:
        """Return the quantiles of `values`."""
        if not len(values):
            return cls(*[float("nan")] * 3)
        return cls(*(float(v) for v in np.quantile(values, (0.5, 0.99, 1.0))))


class Slope(NamedTuple):
    """
    Slope of a line through samples, by least squares.

    Its standard error accounts for the autocorrelation of the deviations, which is high if memory
    grows in steps: the number of independent samples is n (1 - r)/(1 + r), with the lag-1
    autocorrelation r of the deviations (Santer et al. 2000, J. Geophys. Res. 105, 7337, eq. 6).
    """

    value: float
    error: float

    @classmethod
    def of(cls, time: Sequence[float], values: Sequence[float]) -> Self:
        """Return the slope of `values` over `time`, at least three of them."""
        at = np.asarray(time) - np.mean(time)
        value, mean = np.polyfit(at, values, 1)
        off = np.asarray(values) - mean - value * at
        deviance = off @ off
        correlation = max(float(off[1:] @ off[:-1] / deviance), 0.0) if deviance else 0.0
        # Not below three: two samples have no deviations from a line.
        independent = max(len(at) * (1.0 - correlation) / (1.0 + correlation), 3.0)
        return cls(float(value), float(np.sqrt(deviance / (independent - 2.0) / (at @ at))))
