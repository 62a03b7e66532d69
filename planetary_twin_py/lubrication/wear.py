"""Wear of sliding flanks (Archard 1953), and how an oil film lessens it.

A point of a flank is under the pressure p while the contact moves over it, a way 2 b relative to
the flank. With dh/ds = k p over the sliding way s, the width of the contact cancels: each passage
removes k (F/L) |1 - V2/V1| (Andersson and Eriksson 1990; Flodin and Andersson 1997), V1 being the
speed of the flank relative to the contact and V2 that of the other one.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..gearset.working import WorkingMesh

Array = NDArray[np.float64]

NO_FILM, FULL_FILM = 0.5, 4.0  # specific films of Priest and Taylor 2000


def depth_of_passage(coefficient: float, line_load: float, slip: float) -> float:
    """Depth that one passage of the contact removes [m].

    Args:
        coefficient: wear coefficient k [1/Pa].
        line_load: load over the length of the contact line, F/L [N/m].
        slip: |1 - V2/V1| [-].
    """
    return coefficient * line_load * slip


def slips(mesh: WorkingMesh, position: Array) -> tuple[Array, Array]:
    """|1 - V2/V1| and |1 - V1/V2| of both flanks of a pair [-], (...) each.

    The flanks move at V = rho omega, so neither depends on the speed of the gears.

    Args:
        mesh: both gears at their centre distance.
        position: of the contact after the pitch point [base pitches], (...).
    """
    rho1, rho2 = mesh.curvatures_at(position)
    ratio = (rho2 / mesh.second.teeth) / (rho1 / mesh.first.teeth)
    return np.abs(1.0 - ratio), np.abs(1.0 - 1.0 / ratio)


def _constant(specific_film: Array) -> Array:
    return np.ones_like(specific_film)


def _priest_taylor(specific_film: Array) -> Array:
    """1 below a specific film of 0.5, 0 above 4, linear between (Priest and Taylor 2000)."""
    return np.asarray(np.clip((FULL_FILM - specific_film) / (FULL_FILM - NO_FILM), 0.0, 1.0))


FILM_FACTORS: dict[str, Callable[[Array], Array]] = {
    "constant": _constant,
    "priest_taylor": _priest_taylor,
}
"""Wear coefficient over that without film, by the specific film thickness, by name."""
