"""What the profile of worn flanks changes in a mesh: transmission error and backlash."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .flanks import Depths, Flanks

Array = NDArray[np.float64]

CYCLE = 400  # positions in a mesh cycle


def _cycle(flanks: Flanks) -> Array:
    """Positions of a pair over a mesh cycle from the start of the path [base pitches]."""
    return np.asarray((np.arange(CYCLE) + 0.5) / CYCLE - flanks.mesh.path.approach)


def static_error(flanks: Flanks, depths: Depths, force: Array) -> Array:
    """Transmission error over a mesh cycle of a mesh with the forces of a run [m].

    Args:
        flanks: of the kind of mesh.
        depths: their wear.
        force: of the mesh as a pair passes the grid [N], (points,).
    """
    pairs = flanks.pairs.worn(flanks.position, depths.first + depths.second)
    position = _cycle(flanks)
    return np.asarray(pairs.at(position, np.interp(position, flanks.position, force)).deflection)


def unloaded_gap(flanks: Flanks, depths: Depths) -> float:
    """Mean over a mesh cycle of the distance of unloaded flanks by wear [m]."""
    pairs = flanks.pairs.worn(flanks.position, depths.first + depths.second)
    path, position = flanks.mesh.path, _cycle(flanks)[:, None] + np.arange(4)
    gap = np.where(position < path.recess, pairs.gap.at(position), math.inf)
    return float(gap.min(axis=1).mean())
