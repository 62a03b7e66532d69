"""The semi-implicit Euler method with a fixed step: speeds first, then places by the new speeds."""

from __future__ import annotations

import numpy as np

from ..._compile import allocating
from .equations import derivative


@allocating
def march(
    problem: np.ndarray, times: np.ndarray, steps: int, y: np.ndarray, samples: np.ndarray
) -> None:
    """Take y from times[0] on; samples[k] is y at times[k + 1], `steps` steps after times[k]."""
    own, dy = problem[0], np.empty(y.size)
    bodies = own.model.train.bodies
    for k in range(len(samples)):
        h = (times[k + 1] - times[k]) / steps
        for j in range(steps):
            derivative(own, times[k] + j * h, y, dy)
            y[bodies:] += h * dy[bodies:]
            y[:bodies] += h * y[bodies : 2 * bodies]
        samples[k] = y
