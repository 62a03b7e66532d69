"""State of a plant at the times of successive samples of a sensor."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Chunk(NamedTuple):
    """Successive samples, with the state of the plant at their times; (n,) each."""

    sample: NDArray[np.int64]
    """Numbers of the samples; sample 0 is taken at time 0."""
    time: Array
    """[s]"""
    angle: Array
    """Angle of the input since time 0 [rad]."""
    torque: Array
    """Torque at the input [N m]."""
    cycles: Array
    """Mesh cycles since time 0."""
