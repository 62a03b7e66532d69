"""How fast a body turns: with the rigid frame, and against it."""

from __future__ import annotations

import numpy as np

from .._compile import law
from .._records import Record


@law
def body_speed(train: Record, state: Record, v: np.ndarray, j: int) -> float:
    """Absolute speed of body j [rad/s]."""
    rigid = train.ratio[j, 0] * state.speed[0] + train.ratio[j, 1] * state.speed[1]
    return rigid + v[j] * train.inverse_radius[j]
