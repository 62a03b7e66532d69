"""SUNDIALS CVODE with nothing interpreted between its steps: the library of scikit-sundae, called
from compiled code, calls a compiled right-hand side.

Samples come from CVODE's own interpolation. BDF solves its equations by Newton's iteration with a
dense matrix of difference quotients, Adams by fixed-point iteration, as CVODE's guide advises for
problems that are not stiff.
"""

from __future__ import annotations

import ctypes
from functools import cache
from typing import Any

import numba
import numpy as np
from numba import carray, types  # type: ignore[attr-defined]

from . import sundials
from .equations import PROBLEM, derivative
from .problem import Problem
from .solver import Deadline, Solver, SolverError

MOST_STEPS = 100_000  # between two samples
CHUNK = 50  # samples between two looks at the clock


@cache
def _function() -> Any:
    """The right-hand side as CVODE calls it."""
    numbers = _as(ctypes.POINTER(ctypes.c_double), "N_VGetArrayPointer", ctypes.c_void_p)
    problem_type = types.CPointer(numba.from_dtype(PROBLEM))  # type: ignore[no-untyped-call]

    @numba.cfunc(types.intc(types.double, types.voidptr, types.voidptr, problem_type))
    def function(t: float, y: Any, dy: Any, problems: Any) -> int:
        problem = carray(problems, 1)[0]
        size = 2 * problem.model.train.bodies + problem.model.train.axes
        derivative(problem, t, carray(numbers(y), size), carray(numbers(dy), size))
        return 0

    return function


@cache
def _march() -> Any:
    """The loop over samples."""
    integer, real, address = ctypes.c_int, ctypes.c_double, ctypes.c_size_t
    advance = _as(integer, "CVode", address, real, address, address, integer)
    normal = sundials.NORMAL

    @numba.njit
    def march(
        memory: int, vector: int, times: np.ndarray, y: np.ndarray, samples: np.ndarray
    ) -> int:
        reached = np.empty(1)
        for k in range(len(times)):
            status = advance(memory, times[k], vector, reached.ctypes.data, normal)
            if status < 0:
                return status
            samples[k] = y
        return 0

    return march


def _as(answer: Any, name: str, *arguments: Any) -> Any:
    """A function of the library with types that numba can call."""
    address = ctypes.cast(getattr(sundials.library(), name), ctypes.c_void_p).value
    assert address is not None
    return ctypes.CFUNCTYPE(answer, *arguments)(address)


def _cvode(method: int) -> Solver:
    def solve(
        problem: Problem, times: np.ndarray, tolerance: float, deadline: Deadline
    ) -> np.ndarray:
        states, march = np.zeros((len(times), problem.size)), _march()
        setting = sundials.Setting(
            method, _function().address, problem.record.ctypes.data, tolerance,
            tolerance * problem.scale, MOST_STEPS,
        )  # fmt: skip
        with sundials.cvode(setting) as (memory, vector, y):
            for k in range(0, len(times), CHUNK):
                part = slice(k, k + CHUNK)
                status = march(memory, vector, times[part], y, states[part])
                if status < 0:
                    raise SolverError(f"CVODE returned {status}")
                deadline.check()
        return states

    return solve


SOLVERS: dict[str, Solver] = {
    "cvode_bdf_compiled": _cvode(sundials.BDF),
    "cvode_adams_compiled": _cvode(sundials.ADAMS),
}
