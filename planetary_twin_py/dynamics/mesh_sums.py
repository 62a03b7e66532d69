"""What a stretch of time adds up to in each mesh: integrals and extremes.

Statistics of windows and runs follow from them, whatever samples are taken.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .. import _core


class MeshSums(NamedTuple):
    """A `_core.MeshSums` as arrays over the meshes that are integrated."""

    time: float
    """Length of the stretch [s]."""
    integral: np.ndarray
    """(SUMS, meshes)"""
    dte_peak: np.ndarray
    """[m], (meshes,)"""
    force_peak: np.ndarray
    """[N], (meshes,)"""


def mesh_sums(record: _core.MeshSums, meshes: int) -> MeshSums:
    """A copy of `record` without the room for meshes beyond `meshes`."""
    peaks = (record.dte_peak[:meshes].copy(), record.force_peak[:meshes].copy())
    return MeshSums(float(record.time), record.integral[:, :meshes].copy(), *peaks)


def in_order(sums: MeshSums, place: np.ndarray) -> MeshSums:
    """The same of the meshes `place` (meshes,) among those that are integrated."""
    peaks = sums.dte_peak[place], sums.force_peak[place]
    return MeshSums(sums.time, sums.integral[:, place], *peaks)


def clear(total: _core.MeshSums) -> None:
    """Let `total` begin again."""
    total.time = 0.0
    total.integral[:] = total.dte_peak[:] = total.force_peak[:] = 0.0
