"""What a quasi-static run adds up: the energy ledger, and integrals and extremes of its meshes."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .._compile import kernel
from .._records import MESHES, Record
from ..dynamics.mesh_sums import CLIPPED, CONTACT, FILMED, SQUARE, SUMS, MeshSums
from ..dynamics.observe import DTE, FILM, MESH_FORCE, QUANTITIES, VISCOUS
from ..dynamics.state import LEDGER

# Entries of the totals, one after the other: the ledger, integrals of the meshes (SUMS, MESHES),
# and the time.
ENERGY, MEAN = slice(0, LEDGER), slice(LEDGER, LEDGER + SUMS * MESHES + 1)
TOTALS = LEDGER + SUMS * MESHES + 1
# Rows of the peaks: largest magnitudes of transmission error and force, and room for them at both
# ends of a panel.
DTE_PEAK, FORCE_PEAK, PEAKS = 0, 1, 6

NODES, WEIGHTS = (np.array(a) for a in np.polynomial.legendre.leggauss(4))
# Values at both ends of a panel from those at its nodes.
_ENDS = np.array(
    [
        [
            np.prod([(end - b) / (a - b) for b in NODES if b != a])
            for a in NODES
        ]
        for end in (-1.0, 1.0)
    ]
)  # fmt: skip


class Totals(NamedTuple):
    """Those of a run so far."""

    integral: np.ndarray
    """(TOTALS,)"""
    peak: np.ndarray
    """(PEAKS, MESHES)"""
    shown: np.ndarray
    """(QUANTITIES, meshes), room to work in"""


@kernel
def add_rates(
    train: Record, power: np.ndarray, shown: np.ndarray, weight: float, out: np.ndarray
) -> None:
    """Add what grows at one instant, times `weight` [s], to the totals `out` (TOTALS,).

    Args:
        train: a TRAIN.
        power: of the ledger (LEDGER,).
        shown: by the meshes (QUANTITIES, meshes), see `observe`.
    """
    for e in range(LEDGER):
        out[e] += weight * power[e]
    for i in range(train.meshes):
        first = LEDGER + i
        for q in range(QUANTITIES):
            if not math.isnan(shown[q, i]):
                out[first + q * MESHES] += weight * shown[q, i]
        touching = shown[MESH_FORCE, i] != 0.0
        out[first + SQUARE * MESHES] += weight * shown[DTE, i] * shown[DTE, i]
        out[first + CONTACT * MESHES] += weight if touching else 0.0
        out[first + CLIPPED * MESHES] += weight if touching and shown[VISCOUS, i] == 0.0 else 0.0
        out[first + FILMED * MESHES] += 0.0 if math.isnan(shown[FILM, i]) else weight
    out[TOTALS - 1] += weight


@kernel
def see_node(train: Record, shown: np.ndarray, n: int, peak: np.ndarray) -> None:
    """Raise `peak` (PEAKS, MESHES) to what is shown at node n of a panel, the first of them 0."""
    for i in range(train.meshes):
        for row, value in ((DTE_PEAK, shown[DTE, i]), (FORCE_PEAK, shown[MESH_FORCE, i])):
            peak[row, i] = max(peak[row, i], abs(value))
            for end in range(2):
                room = 2 + 2 * row + end
                before = 0.0 if n == 0 else peak[room, i]
                peak[room, i] = before + _ENDS[end, n] * value


@kernel
def see_ends(train: Record, peak: np.ndarray) -> None:
    """Raise `peak` to the ends of the panel whose nodes have been seen."""
    for i in range(train.meshes):
        for row in range(2):
            at_ends = max(abs(peak[2 + 2 * row, i]), abs(peak[3 + 2 * row, i]))
            peak[row, i] = max(peak[row, i], at_ends)


def mesh_sums(totals: np.ndarray, peak: np.ndarray, meshes: int) -> MeshSums:
    """Those of `meshes` meshes, from their part MEAN of the totals, and peaks (2, MESHES)."""
    integral = totals[:-1].reshape(SUMS, MESHES)[:, :meshes].copy()
    return MeshSums(float(totals[-1]), integral, *peak[:2, :meshes].copy())
