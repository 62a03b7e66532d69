"""What a stretch of time adds up to in each mesh: integrals and extremes.

Statistics of windows and runs follow from them, whatever samples are taken.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .._compile import kernel
from .._overwrite import overwrite
from .._records import MESHES, REAL, Record, layout
from .observe import QUANTITIES

# Rows of the integrals: those of `observe`, then the square of the transmission error, the time for
# which a force acts, that for which it acts without viscous friction, and that for which film and
# lambda ratio are known.
SQUARE, CONTACT, CLIPPED, FILMED = range(QUANTITIES, QUANTITIES + 4)
SUMS = QUANTITIES + 4

MESH_SUMS = layout(
    time=REAL,  # length of the stretch [s]
    integral=(REAL, (SUMS, MESHES)),  # over it
    dte_peak=(REAL, (MESHES,)),  # largest magnitude [m]
    force_peak=(REAL, (MESHES,)),  # largest magnitude [N]
)


class MeshSums(NamedTuple):
    """A MESH_SUMS as arrays over the meshes that are integrated."""

    time: float
    """Length of the stretch [s]."""
    integral: np.ndarray
    """(SUMS, meshes)"""
    dte_peak: np.ndarray
    """[m], (meshes,)"""
    force_peak: np.ndarray
    """[N], (meshes,)"""


def mesh_sums(record: Record, meshes: int) -> MeshSums:
    """A copy of `record`, a MESH_SUMS, without the room for meshes beyond `meshes`."""
    peaks = (record.dte_peak[:meshes].copy(), record.force_peak[:meshes].copy())
    return MeshSums(float(record.time), record.integral[:, :meshes].copy(), *peaks)


def in_order(sums: MeshSums, place: np.ndarray) -> MeshSums:
    """The same of the meshes `place` (meshes,) among those that are integrated."""
    peaks = sums.dte_peak[place], sums.force_peak[place]
    return MeshSums(sums.time, sums.integral[:, place], *peaks)


def clear(total: Record) -> None:
    """Let `total`, a MESH_SUMS, begin again."""
    total.time = 0.0
    total.integral[:] = total.dte_peak[:] = total.force_peak[:] = 0.0


@kernel
def add_sums(step: Record, total: Record, lanes: int) -> None:
    """Lengthen `total` by `step`, both a MESH_SUMS; `lanes` is that of the TRAIN."""
    if total.time == 0.0:
        overwrite(total, step)
        return
    total.time += step.time
    for row in range(SUMS):
        for i in range(lanes):
            total.integral[row, i] += step.integral[row, i]
    for i in range(lanes):
        total.dte_peak[i] = max(total.dte_peak[i], step.dte_peak[i])
        total.force_peak[i] = max(total.force_peak[i], step.force_peak[i])
