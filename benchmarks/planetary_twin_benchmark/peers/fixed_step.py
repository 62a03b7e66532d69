"""Compiled baselines with a fixed step, which divides the interval between two samples.

Their errors fall with the step alone, and only as its first power, since switches fall anywhere
within it: the tolerance is taken as the step in mesh cycles.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from planetary_twin_core_parts import Problem as Record
from planetary_twin_core_parts import runge_kutta_4, semi_implicit_euler

from .problem import Problem
from .solver import Deadline, Solver, SolverError

CHUNK = 50  # samples between two looks at the clock


# (problem, times, steps between two of them, y, samples), see the core.
Integrate = Callable[[Record, np.ndarray, int, np.ndarray, np.ndarray], None]


def _fixed_step(integrate: Integrate) -> Solver:
    def solve(
        problem: Problem, times: np.ndarray, tolerance: float, deadline: Deadline
    ) -> np.ndarray:
        y, states = np.zeros(problem.size), np.zeros((len(times), problem.size))
        instants = np.concatenate([[0.0], times])
        steps = math.ceil(times[0] / (tolerance * problem.mesh_period))
        for k in range(0, len(times), CHUNK):
            integrate(problem.record, instants[k : k + CHUNK + 1], steps, y, states[k : k + CHUNK])
            deadline.check()
            if not np.isfinite(y).all():
                raise SolverError("unstable")
        return states

    return solve


SOLVERS: dict[str, Solver] = {
    "rk4": _fixed_step(runge_kutta_4),
    "semi_implicit_euler": _fixed_step(semi_implicit_euler),
}
