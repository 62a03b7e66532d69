"""Integrals and extremes of each mesh over a time interval.

Statistics of windows and runs follow from them, independent of the samples.
"""

from __future__ import annotations

from types import ModuleType
from typing import NamedTuple

import numpy as np

from .. import _core


class MeshSums(NamedTuple):
    """A `_core.MeshSums` as arrays over the integrated meshes."""

    time: float
    """Length of the interval [s]."""
    integral: np.ndarray
    """(SUMS, meshes)"""
    dte_peak: np.ndarray
    """[m], (meshes,)"""
    force_peak: np.ndarray
    """[N], (meshes,)"""


def mesh_sums(record: _core.MeshSums, meshes: int) -> MeshSums:
    """A copy of `record` with its first `meshes` meshes."""
    peaks = (record.dte_peak[:meshes].copy(), record.force_peak[:meshes].copy())
    return MeshSums(float(record.time), record.integral[:, :meshes].copy(), *peaks)


def record_of(sums: MeshSums, core: ModuleType) -> _core.MeshSums:
    """The same as a record of a build of the core."""
    record: _core.MeshSums = core.MeshSums(
        time=sums.time,
        integral=sums.integral,
        dte_peak=sums.dte_peak,
        force_peak=sums.force_peak,
    )
    return record


def in_order(sums: MeshSums, place: np.ndarray) -> MeshSums:
    """The sums of the meshes with indices `place` (meshes,) among the integrated meshes."""
    peaks = sums.dte_peak[place], sums.force_peak[place]
    return MeshSums(sums.time, sums.integral[:, place], *peaks)


def clear(total: _core.MeshSums) -> None:
    """Set `total` to zero."""
    total.time = 0.0
    total.integral[:] = total.dte_peak[:] = total.force_peak[:] = 0.0
