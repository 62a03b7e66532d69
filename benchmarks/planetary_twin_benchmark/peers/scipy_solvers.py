"""SciPy's solve_ivp, calling the compiled right-hand side through Python.

Samples come from the dense output of its steps (`t_eval`), which costs no further evaluation but
for DOP853, where it takes three in a step.
"""

from __future__ import annotations

import numpy as np
from scipy.integrate import BDF, DOP853, LSODA, OdeSolver, Radau, solve_ivp

from .problem import Problem
from .solver import Deadline, Solver, SolverError

METHODS: tuple[type[OdeSolver], ...] = (LSODA, Radau, BDF, DOP853)


def _scipy(method: type[OdeSolver]) -> Solver:
    def solve(
        problem: Problem, times: np.ndarray, tolerance: float, deadline: Deadline
    ) -> np.ndarray:
        found = solve_ivp(
            problem.function(deadline.check), (0.0, times[-1]), np.zeros(problem.size),
            method=method, t_eval=times, rtol=tolerance, atol=tolerance * problem.scale,
        )  # fmt: skip
        if not found.success:
            raise SolverError(found.message)
        return found.y.T

    return solve


SOLVERS = {f"scipy_{method.__name__.lower()}": _scipy(method) for method in METHODS}
