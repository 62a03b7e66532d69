"""How natural frequencies follow the stiffness of each kind of spring.

d(w^2)/dk = phi^T dK/dk phi for a mass-normalised mode (Fox and Kapoor 1968). Modes of one
frequency part in the directions that diagonalise the same product.
"""

from __future__ import annotations

import numpy as np

from .modes import clusters, modes_of
from .springs import SpringModel


def frequency_sensitivities(model: SpringModel) -> dict[str, np.ndarray]:
    """df/dk [Hz m/N] of every mode, ascending within modes of one frequency, by kind of spring.

    NaN for rigid modes, whose frequency grows as the root of the stiffness that hits them.
    """
    modes = modes_of(model)
    result = {}
    for kind in dict.fromkeys(spring.kind for spring in model.springs):
        rows = np.array([spring.row for spring in model.springs if spring.kind == kind])
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
