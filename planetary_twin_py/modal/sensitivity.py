"""Sensitivity of natural frequencies to the stiffness of each kind of spring.

d(w^2)/dk = phi^T dK/dk phi for a mass-normalised mode (Fox and Kapoor 1968). Modes with equal
frequencies separate in the directions that diagonalise this product.
"""

from __future__ import annotations

import math

import numpy as np

from .modes import clusters, modes_of
from .springs import SpringModel


def frequency_sensitivities(model: SpringModel) -> dict[str, np.ndarray]:
    """Derivatives of the natural frequencies with respect to stiffness (Fox and Kapoor 1968).

    The stiffness of a kind is that of a spring with `factor` 1.

    Args:
        model: masses and springs.

    Returns:
        df/dk [Hz m/N] by kind of spring, (modes,), ascending among modes with equal frequencies. It
        is NaN for rigid modes, whose frequency is proportional to the root of an added stiffness.
    """
    modes = modes_of(model)
    result = {}
    for kind in dict.fromkeys(spring.kind for spring in model.springs):
        springs = [spring for spring in model.springs if spring.kind == kind]
        rows = np.array([math.sqrt(spring.factor) * spring.row for spring in springs])
        stretch = rows @ modes.shapes
        slopes = np.full(len(modes.frequencies), np.nan)
        for cluster in clusters(modes.frequencies):
            frequency = modes.frequencies[cluster.start]
            if frequency > 0.0:
                part = stretch[:, cluster]
                squares = np.linalg.eigvalsh(part.T @ part)
                slopes[cluster] = squares / (8.0 * np.pi**2 * frequency)
        result[kind] = slopes
    return result
