"""Predictions of held-out readings, with intervals, for comparison with these readings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .estimate import Estimate
from .least_squares import Residuals, differentiate
from .misfit import WeightedReadings, means_of
from .parameter import Parameter
from .readings import Array, Readings
from .simulations import Simulations


class Predicted(NamedTuple):
    """Means of one observable over the operating points that were held out."""

    name: str
    measured: Array
    """Measured means in SI, (points, channels)."""
    predicted: Array
    """Predicted means in SI, (points, channels)."""
    reach: Array
    """Half of the interval of a prediction, (points, channels)."""

    @property
    def inside(self) -> float:
        """Share of the measured means within their intervals."""
        return float(np.mean(np.abs(self.measured - self.predicted) <= self.reach))

    @property
    def rms(self) -> float:
        """Root mean square of the relative errors."""
        return float(np.sqrt(np.mean((self.predicted / self.measured - 1.0) ** 2)))


@dataclass(frozen=True)
class Fitted:
    """Data of a fit that a prediction needs."""

    parameters: tuple[Parameter, ...]
    estimate: Estimate
    weighted: WeightedReadings
    """Readings that were fitted."""
    confidence: float
    """Level of the intervals."""


def predict(
    runs: Simulations, held_out: tuple[Readings, ...], fitted: Fitted
) -> tuple[Predicted, ...]:
    """Predict the means over operating points that were held out.

    The variance of a new mean is the variance of the estimates, propagated through the model, plus
    the variance of a mean about the model, estimated from the fitted operating points (Draper and
    Smith 1998, Applied Regression Analysis, ch. 24). The second part contains model errors if the
    residuals are larger than the noise of the readings. Raises `ArithmeticError` if an operating
    point cannot be simulated.
    """
    from scipy.stats import t

    values, estimate, weighted = fitted.estimate.values, fitted.estimate, fitted.weighted
    degrees = max(weighted.count - len(values), 1)
    freedom = weighted.freedom if estimate.excess == 1.0 else min(weighted.freedom, degrees)
    quantile = float(t.ppf(0.5 + 0.5 * fitted.confidence, freedom))
    output = runs.at([values])[0]
    if output is None:
        raise ArithmeticError("the operating points that are held out cannot be simulated")
    predictions = []
    for k, readings in enumerate(held_out):
        predicted = means_of(output.readings[k])
        slopes = differentiate(_means_at(runs, k), fitted.parameters, values)
        estimate_variance = np.einsum("mp,pq,mq->m", slopes, estimate.covariance, slopes)
        scatter = np.mean(weighted.noise[k].mean ** 2, axis=0)
        variance = estimate.excess * (estimate_variance.reshape(predicted.shape) + scatter)
        predictions.append(
            Predicted(readings.name, means_of(readings), predicted, quantile * np.sqrt(variance))
        )
    return tuple(predictions)


def _means_at(runs: Simulations, place: int) -> Residuals:
    """Function that returns the means of one observable at several points."""

    def means(points: Sequence[Array]) -> list[Array | None]:
        return [
            None if out is None else means_of(out.readings[place]).ravel()
            for out in runs.at(points)
        ]

    return means
