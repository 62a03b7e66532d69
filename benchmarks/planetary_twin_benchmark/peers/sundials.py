"""C functions of the CVODE library in the package scikit-sundae.

Hindmarsh et al. 2005, "SUNDIALS: Suite of nonlinear and differential/algebraic equation solvers".
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import cache
from importlib import metadata
from typing import Any, NamedTuple

import numpy as np

ADAMS, BDF = 1, 2  # CV_ADAMS, CV_BDF
NORMAL = 1  # CV_NORMAL: step past the time asked for, and interpolate
NO_COMMUNICATOR = 0  # SUN_COMM_NULL

_POINTER, _REAL, _INT, _INDEX = ctypes.c_void_p, ctypes.c_double, ctypes.c_int, ctypes.c_int32
_FUNCTIONS: dict[str, tuple[Any, list[Any]]] = {  # what it returns, what it takes
    "SUNContext_Create": (_INT, [_INT, _POINTER]),
    "SUNContext_ClearErrHandlers": (_INT, [_POINTER]),
    "SUNContext_Free": (_INT, [_POINTER]),
    "N_VMake_Serial": (_POINTER, [_INDEX, _POINTER, _POINTER]),
    "N_VGetArrayPointer": (_POINTER, [_POINTER]),
    "N_VGetLength": (_INDEX, [_POINTER]),
    "N_VDestroy": (None, [_POINTER]),
    "SUNDenseMatrix": (_POINTER, [_INDEX, _INDEX, _POINTER]),
    "SUNMatDestroy": (None, [_POINTER]),
    "SUNLinSol_Dense": (_POINTER, [_POINTER, _POINTER, _POINTER]),
    "SUNLinSolFree": (_INT, [_POINTER]),
    "SUNNonlinSol_FixedPoint": (_POINTER, [_POINTER, _INT, _POINTER]),
    "SUNNonlinSolFree": (_INT, [_POINTER]),
    "CVodeCreate": (_POINTER, [_INT, _POINTER]),
    "CVodeInit": (_INT, [_POINTER, _POINTER, _REAL, _POINTER]),
    "CVodeSVtolerances": (_INT, [_POINTER, _REAL, _POINTER]),
    "CVodeSetUserData": (_INT, [_POINTER, _POINTER]),
    "CVodeSetMaxNumSteps": (_INT, [_POINTER, ctypes.c_long]),
    "CVodeSetLinearSolver": (_INT, [_POINTER, _POINTER, _POINTER]),
    "CVodeSetNonlinearSolver": (_INT, [_POINTER, _POINTER]),
    "CVode": (_INT, [_POINTER, _REAL, _POINTER, _POINTER, _INT]),
    "CVodeFree": (None, [_POINTER]),
}


class Setting(NamedTuple):
    """Problem and settings for CVODE."""

    method: int  # ADAMS or BDF
    function: int  # address of a CVRhsFn
    data: int  # address of what it gets as its user data
    relative: float
    absolute: np.ndarray  # (size,)
    most_steps: int  # between two samples


class Solver(NamedTuple):
    """Addresses of the memory of CVODE and of the vector with the values `y`."""

    memory: int
    vector: int
    y: np.ndarray


@cache
def library() -> ctypes.CDLL:
    """CVODE and the libraries it needs, with typed functions.

    Raises:
        importlib.metadata.PackageNotFoundError: scikit-sundae is not installed.
    """
    files = metadata.files("scikit-sundae") or []
    path = next(file for file in files if file.name.startswith("libsundials_cvode"))
    found = ctypes.CDLL(str(path.locate()))
    for name, (answer, arguments) in _FUNCTIONS.items():
        function = getattr(found, name)
        function.restype, function.argtypes = answer, arguments
    return found


@contextmanager
def cvode(setting: Setting) -> Iterator[Solver]:
    """A CVODE solver that starts from y = 0 at time zero and is freed at the end."""
    lib, y = library(), np.zeros(len(setting.absolute))
    with ExitStack() as held:
        context = _POINTER()
        _check(lib.SUNContext_Create(NO_COMMUNICATOR, ctypes.byref(context)), "SUNContext_Create")
        held.callback(lib.SUNContext_Free, ctypes.byref(context))
        lib.SUNContext_ClearErrHandlers(context)  # the return value of CVode reports failures
        vector = _vector(held, y, context)
        memory = lib.CVodeCreate(setting.method, context)
        held.callback(lib.CVodeFree, ctypes.byref(_POINTER(memory)))
        _check(lib.CVodeInit(memory, setting.function, 0.0, vector), "CVodeInit")
        weights = _vector(held, setting.absolute, context)
        _check(lib.CVodeSVtolerances(memory, setting.relative, weights), "CVodeSVtolerances")
        _check(lib.CVodeSetUserData(memory, setting.data), "CVodeSetUserData")
        _check(lib.CVodeSetMaxNumSteps(memory, setting.most_steps), "CVodeSetMaxNumSteps")
        attach = _newton if setting.method == BDF else _fixed_point
        attach(held, memory, vector, context)
        yield Solver(memory, vector, y)


def _vector(held: ExitStack, numbers: np.ndarray, context: ctypes.c_void_p) -> int:
    lib = library()
    vector = lib.N_VMake_Serial(len(numbers), numbers.ctypes.data, context)
    held.callback(lib.N_VDestroy, vector)
    return vector


def _newton(held: ExitStack, memory: int, vector: int, context: ctypes.c_void_p) -> None:
    """Newton's iteration with a dense matrix of difference quotients."""
    lib = library()
    size = lib.N_VGetLength(vector)
    matrix = lib.SUNDenseMatrix(size, size, context)
    held.callback(lib.SUNMatDestroy, matrix)
    linear = lib.SUNLinSol_Dense(vector, matrix, context)
    held.callback(lib.SUNLinSolFree, linear)
    _check(lib.CVodeSetLinearSolver(memory, linear, matrix), "CVodeSetLinearSolver")


def _fixed_point(held: ExitStack, memory: int, vector: int, context: ctypes.c_void_p) -> None:
    lib = library()
    iteration = lib.SUNNonlinSol_FixedPoint(vector, 0, context)
    held.callback(lib.SUNNonlinSolFree, iteration)
    _check(lib.CVodeSetNonlinearSolver(memory, iteration), "CVodeSetNonlinearSolver")


def _check(status: int, name: str) -> None:
    if status < 0:
        raise RuntimeError(f"{name} of SUNDIALS returned {status}")
