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
    """Slope of a line through samples, by least squares."""

    value: float
    error: float  # standard error of `value`, as if the deviations were independent

    @classmethod
    def of(cls, time: Sequence[float], values: Sequence[float]) -> Self:
        """Return the slope of `values` over `time`, at least three of them."""
        (slope, _), covariance = np.polyfit(time, values, 1, cov=True)
        return cls(float(slope), float(np.sqrt(covariance[0, 0])))
