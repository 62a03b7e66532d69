"""SUNDIALS CVODE by scikit-sundae, calling the compiled right-hand side through Python.

Samples come from CVODE's own interpolation. Both methods solve their equations by Newton's
iteration with a dense matrix of difference quotients: the package offers no other.
"""

from __future__ import annotations

import numpy as np
from planetary_twin_core_parts import derivative

from .problem import Problem
from .solver import Deadline, Solver, SolverError

MOST_STEPS = 1_000_000  # between two samples


def _cvode(method: str) -> Solver:
    def solve(
        problem: Problem, times: np.ndarray, tolerance: float, deadline: Deadline
    ) -> np.ndarray:
        from sksundae.cvode import CVODE

        def function(t: float, y: np.ndarray, dy: np.ndarray) -> None:
            deadline.check()
            derivative(problem.record, t, y, dy)

        solver = CVODE(
            function, method=method, rtol=tolerance, atol=tolerance * problem.scale,
            max_num_steps=MOST_STEPS,
        )  # fmt: skip
        found = solver.solve(np.concatenate([[0.0], times]), np.zeros(problem.size))
        if not found.success:
            raise SolverError(found.message)
        return found.y[1:]

    return solve


SOLVERS = {f"cvode_{method.lower()}": _cvode(method) for method in ("BDF", "Adams")}
