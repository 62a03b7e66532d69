"""Mean stiffness of the two kinds of mesh, with healthy teeth."""

from __future__ import annotations

import numpy as np

from .._core import TOTAL
from .._core import Teeth as TeethRecord
from ..mesh.tooth_pairs import mean_weight
from .teeth import Teeth


def mean_stiffness(teeth: Teeth | TeethRecord) -> np.ndarray:
    """Mean over the mesh cycle [N/m], shape (2,): sun-planet meshes, planet-ring meshes.

    Those of a planet have the factor `errors.planet_stiffness` as well.
    """
    mean = [
        mean_weight(edge, weight[:, TOTAL])
        for edge, weight in zip(teeth.edge, teeth.weight, strict=True)
    ]
    return np.asarray(teeth.stiffness_base + teeth.stiffness_gain * mean)
