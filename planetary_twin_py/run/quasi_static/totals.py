"""Totals of a quasi-static run: the energy ledger, integrals and extremes of the meshes."""

from __future__ import annotations

import numpy as np

from ..._core import LEDGER, SUMS
from ...model.mesh_sums import MeshSums

# Entries of the totals, in this order: the ledger, integrals of the meshes (SUMS, room),
# and the time.
ENERGY, MEAN = slice(0, LEDGER), slice(LEDGER, None)


def mesh_sums(totals: np.ndarray, peak: np.ndarray, meshes: int) -> MeshSums:
    """Sums of `meshes` meshes, from the part MEAN of the totals and from peaks (2, room)."""
    integral = totals[:-1].reshape(SUMS, -1)[:, :meshes].copy()
    return MeshSums(float(totals[-1]), integral, *peak[:2, :meshes].copy())
