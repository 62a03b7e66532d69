"""Gain and phase of a path over frequency: the sum of some poles, or a table."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..scene.sensors.paths import FilteredWindow
from .filters import Response
from .mode import Mode

KEPT = 4.0  # periods of the smallest spacing of a table for which its response is kept


def path_response(path: FilteredWindow) -> Response:
    """Response of a path to the force of a mesh, relative to its gain.

    Args:
        path: with poles or a table.
    """
    if path.table:
        return _of_table(path)
    modes = tuple(Mode(math.tau * pole.frequency, pole.damping_ratio) for pole in path.poles)

    def summed(omega: NDArray[np.float64]) -> NDArray[np.complex128]:
        parts = zip(path.poles, modes, strict=True)
        return np.asarray(sum(pole.gain * mode.displacement(omega) for pole, mode in parts))

    return Response(summed, modes)


def _of_table(path: FilteredWindow) -> Response:
    rows = np.array([[row.frequency, row.magnitude, row.phase] for row in path.table])
    frequency, magnitude, phase = rows.T

    def read(omega: NDArray[np.float64]) -> NDArray[np.complex128]:
        at = omega / math.tau
        turned = np.exp(1j * np.interp(at, frequency, phase))
        return np.asarray(np.interp(at, frequency, magnitude) * turned)

    return Response(read, (), KEPT / float(np.diff(frequency).min()))
