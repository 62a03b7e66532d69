"""Mean stiffness of the two kinds of mesh of a train, with healthy teeth."""

from __future__ import annotations

import numpy as np

from .._core import TOTAL, Train
from ..mesh.tooth_pairs import mean_weight


def mean_stiffness(train: Train) -> np.ndarray:
    """Mean over the mesh cycle [N/m], shape (2,): sun-planet meshes, planet-ring meshes.

    Those of a planet have the factor `errors.planet_stiffness` as well.
    """
    mean = [
        mean_weight(edge, weight[:, TOTAL])
        for edge, weight in zip(train.edge, train.weight, strict=True)
    ]
    return np.asarray(train.stiffness_base + train.stiffness_gain * mean)
