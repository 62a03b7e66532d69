"""The mean stiffness of a train's two kinds of mesh, with healthy teeth."""

from __future__ import annotations

import numpy as np

from .._records import Record
from ..mesh.tooth_pairs import TOTAL, mean_weight


def mean_stiffness(train: Record) -> np.ndarray:
    """Over the mesh cycle: of sun-planet, of planet-ring meshes [N/m], shape (2,)."""
    mean = [
        mean_weight(edge, weight[:, TOTAL])
        for edge, weight in zip(train.edge, train.weight, strict=True)
    ]
    return np.asarray(train.stiffness_base + train.stiffness_gain * mean)
