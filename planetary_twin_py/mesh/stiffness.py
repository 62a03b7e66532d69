"""How the stiffness of a mesh follows from its tooth pairs."""

from __future__ import annotations

from typing import NamedTuple

from .tooth_pairs import Along, one


class StiffnessLaw(NamedTuple):
    """Mesh stiffness base + gain * (sum of the pairs' weights), see `tooth_pairs`."""

    single: float  # of a pair alone at the pitch point [N/m]
    base: float  # [N/m]
    gain: float  # [N/m]
    strength: Along  # full weight of a pair at its positions


def given_stiffness(single: float, double_pair_ratio: float) -> StiffnessLaw:
    """A pair alone has `single` [N/m] everywhere, two have `double_pair_ratio` times that."""
    gain = (double_pair_ratio - 1.0) * single
    return StiffnessLaw(single, single - gain, gain, one)
