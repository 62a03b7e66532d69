"""Stiffness of a mesh from its tooth pairs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..gearset.geometry import PathOfContact
from .tooth_pairs import Along, one

DIGITS = 9  # of a law that libraries compute
_POINTS = 257  # on a path of contact: the largest stiffness is within 1e-5


class StiffnessLaw(NamedTuple):
    """Mesh stiffness base + gain * (sum of the pairs' weights), see `tooth_pairs`."""

    single: float  # largest of a single pair on its path of contact, c' of ISO 6336-1 [N/m]
    base: float  # [N/m]
    gain: float  # [N/m]
    strength: Along  # full weight of a pair over its position
    sharing: float = 1.0  # factor on the weights of two pairs at once


def given_stiffness(single: float, double_pair_ratio: float) -> StiffnessLaw:
    """One pair has `single` [N/m] at all positions; two pairs have `double_pair_ratio` times it."""
    gain = (double_pair_ratio - 1.0) * single
    return StiffnessLaw(single, single - gain, gain, one)


def tooth_stiffness(stiffness: Along, path: PathOfContact, sharing: float) -> StiffnessLaw:
    """One pair has `stiffness` [N/m] over its position; two pairs their sum times `sharing`.

    The pitch point may lie off the path of contact, where no pair ever is. All of it is rounded:
    teeth are computed by libraries whose last digits differ by machine.
    """
    largest = stiffness(np.linspace(-path.approach, path.recess, _POINTS)).max()
    single = float(f"{float(largest):.{DIGITS}g}")
    return StiffnessLaw(
        single,
        0.0,
        single,
        lambda s: np.round(stiffness(s) / single, DIGITS),
        round(sharing, DIGITS),
    )
