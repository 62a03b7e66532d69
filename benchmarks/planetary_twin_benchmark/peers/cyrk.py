"""The methods of SciPy and a few more in C++, by the package CyRK, with a compiled right-hand side.

Samples come from the dense output of the steps. A run cannot be interrupted from outside: its limit
is a number of steps, and the deadline is looked at when it has ended.
"""

from __future__ import annotations

import numpy as np
from planetary_twin_core_parts import address_of, cyrk_function

from .problem import Problem
from .solver import Deadline, Solver, SolverError

METHODS = ("LSODA", "RADAU", "BDF", "DOP853", "Tsit5")
MOST_STEPS = 1_000_000


def _cyrk(method: str) -> Solver:
    def solve(
        problem: Problem, times: np.ndarray, tolerance: float, deadline: Deadline
    ) -> np.ndarray:
        from CyRK import nbsolve2_ivp

        address = np.array([address_of(problem.record)]).view(float)  # CyRK passes on its bytes
        found = nbsolve2_ivp(
            cyrk_function(), (0.0, times[-1]), np.zeros(problem.size), method=method,
            t_eval=times, args=address, rtol=tolerance, atols=tolerance * problem.scale,
            max_num_steps=MOST_STEPS,
        )  # fmt: skip
        try:
            if not found.success:
                raise SolverError(found.status_message)
            states = np.array(found.y.T)
        finally:
            found.free()
        deadline.check()
        return states

    return solve


SOLVERS = {f"{method.lower()}_compiled": _cyrk(method) for method in METHODS}
