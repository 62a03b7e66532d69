"""The methods of SciPy and a few more in C++, by the package CyRK, with a compiled right-hand side.

Samples come from the dense output of the steps. A run cannot be interrupted from outside: its limit
is a number of steps, and the deadline is looked at when it has ended.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numba
import numpy as np
from numba import carray, types  # type: ignore[attr-defined]

from .equations import PROBLEM, derivative
from .problem import Problem
from .solver import Deadline, Solver, SolverError

METHODS = ("LSODA", "RADAU", "BDF", "DOP853", "Tsit5")
MOST_STEPS = 1_000_000


@cache
def _function() -> Any:
    """The right-hand side as CyRK calls it; its argument is the address of the problem."""
    numbers = types.CPointer(types.double)  # type: ignore[no-untyped-call]
    problem = types.CPointer(numba.from_dtype(PROBLEM))  # type: ignore[no-untyped-call]
    addresses = types.CPointer(problem)  # type: ignore[no-untyped-call]

    @numba.cfunc(types.void(numbers, types.double, numbers, addresses))
    def function(dy: Any, t: float, y: Any, problems: Any) -> None:
        problem = carray(problems[0], 1)[0]
        size = 2 * problem.model.train.bodies + problem.model.train.axes
        derivative(problem, t, carray(y, size), carray(dy, size))

    return function


def _cyrk(method: str) -> Solver:
    def solve(
        problem: Problem, times: np.ndarray, tolerance: float, deadline: Deadline
    ) -> np.ndarray:
        from CyRK import nbsolve2_ivp

        address = np.array([problem.record.ctypes.data]).view(float)  # CyRK passes on its bytes
        found = nbsolve2_ivp(
            _function().address, (0.0, times[-1]), np.zeros(problem.size), method=method,
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
