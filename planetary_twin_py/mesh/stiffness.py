"""How the stiffness of a mesh follows from its tooth pairs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .tooth_pairs import Along, one


class StiffnessLaw(NamedTuple):
    """Mesh stiffness base + gain * (sum of the pairs' weights), see `tooth_pairs`."""

    single: float  # of a pair alone at the pitch point [N/m]
    base: float  # [N/m]
    gain: float  # [N/m]
    strength: Along  # full weight of a pair at its positions
    sharing: float = 1.0  # factor on the weights of two pairs at once


def given_stiffness(single: float, double_pair_ratio: float) -> StiffnessLaw:
    """A pair alone has `single` [N/m] everywhere, two have `double_pair_ratio` times that."""
    gain = (double_pair_ratio - 1.0) * single
    return StiffnessLaw(single, single - gain, gain, one)


def tooth_stiffness(stiffness: Along, sharing: float) -> StiffnessLaw:
    """A pair has the given `stiffness` [N/m] at its positions, two that of both times `sharing`."""
    single = float(stiffness(np.zeros(1))[0])
    return StiffnessLaw(single, 0.0, single, lambda s: stiffness(s) / single, sharing)
