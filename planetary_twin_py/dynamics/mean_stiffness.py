"""The mean stiffness of a train's two kinds of mesh, with healthy teeth."""

from __future__ import annotations

import numpy as np

from .._core import TOTAL, Train
from ..mesh.tooth_pairs import mean_weight


def mean_stiffness(train: Train) -> np.ndarray:
    """Over the mesh cycle: of sun-planet, of planet-ring meshes [N/m], shape (2,)."""
    mean = [
        mean_weight(edge, weight[:, TOTAL])
        for edge, weight in zip(train.edge, train.weight, strict=True)
    ]
    return np.asarray(train.stiffness_base + train.stiffness_gain * mean)
