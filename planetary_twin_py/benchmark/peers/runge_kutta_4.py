"""The classical Runge-Kutta method of order 4 with a fixed step, switches not aligned with it."""

from __future__ import annotations

import numpy as np

from ..._compile import allocating
from ..._records import Record
from .equations import derivative


@allocating
def march(
    problem: np.ndarray, times: np.ndarray, steps: int, y: np.ndarray, samples: np.ndarray
) -> None:
    """Take y from times[0] on; samples[k] is y at times[k + 1], `steps` steps after times[k]."""
    own, stages = problem[0], np.empty((5, y.size))
    for k in range(len(samples)):
        h = (times[k + 1] - times[k]) / steps
        for j in range(steps):
            _step(own, times[k] + j * h, h, y, stages)
        samples[k] = y


@allocating
def _step(problem: Record, t: float, h: float, y: np.ndarray, stages: np.ndarray) -> None:
    k1, k2, k3, k4, inner = stages[0], stages[1], stages[2], stages[3], stages[4]
    derivative(problem, t, y, k1)
    inner[:] = y + 0.5 * h * k1
    derivative(problem, t + 0.5 * h, inner, k2)
    inner[:] = y + 0.5 * h * k2
    derivative(problem, t + 0.5 * h, inner, k3)
    inner[:] = y + h * k3
    derivative(problem, t + h, inner, k4)
    y += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)
