"""SUNDIALS CVODE without interpreted code between its steps: the library of scikit-sundae, called
from compiled code, calls a compiled right-hand side.

Samples come from CVODE's own interpolation. BDF solves its equations by Newton's iteration with a
dense matrix of difference quotients, Adams by fixed-point iteration, as CVODE's guide advises for
problems that are not stiff.
"""

from __future__ import annotations

import ctypes

import numpy as np
from planetary_twin_core_parts import CvodeProblem

from . import sundials
from .problem import Problem
from .solver import Deadline, Solver, SolverError

MOST_STEPS = 100_000  # between two samples
CHUNK = 50  # samples between two looks at the clock


def _address(name: str) -> int:
    """Address of a function of the library."""
    address = ctypes.cast(getattr(sundials.library(), name), ctypes.c_void_p).value
    assert address is not None
    return address


def callback(problem: Problem) -> CvodeProblem:
    """The right-hand side and its user data, as CVODE takes them."""
    return CvodeProblem(problem.record, _address("N_VGetArrayPointer"), _address("CVode"))


def _cvode(method: int) -> Solver:
    def solve(
        problem: Problem, times: np.ndarray, tolerance: float, deadline: Deadline
    ) -> np.ndarray:
        states = np.zeros((len(times), problem.size))
        own = callback(problem)
        setting = sundials.Setting(
            method, own.function, own.data, tolerance, tolerance * problem.scale, MOST_STEPS
        )
        with sundials.cvode(setting) as (memory, vector, _):
            for k in range(0, len(times), CHUNK):
                part = slice(k, k + CHUNK)
                status = own.integrate(memory, vector, times[part], states[part])
                if status < 0:
                    raise SolverError(f"CVODE returned {status}")
                deadline.check()
        return states

    return solve


SOLVERS: dict[str, Solver] = {
    "cvode_bdf_compiled": _cvode(sundials.BDF),
    "cvode_adams_compiled": _cvode(sundials.ADAMS),
}
