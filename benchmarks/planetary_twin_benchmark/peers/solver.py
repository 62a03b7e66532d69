"""Interface of a peer: a function that solves a `Problem` within a time limit."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from .problem import Problem


class SolverError(Exception):
    """A solver failed, for the given reason."""


class TooSlow(SolverError):
    """A solver exceeded its time limit."""


class Deadline:
    """A time limit, which solvers check at intervals."""

    def __init__(self, seconds: float) -> None:
        self._seconds, self._end = seconds, time.monotonic() + seconds

    def check(self) -> None:
        """Raise TooSlow after the time limit."""
        if time.monotonic() > self._end:
            raise TooSlow(f"over {self._seconds:g} s")


# (problem, sample times [s], relative tolerance, deadline) -> states (samples, size) at the times.
Solver = Callable[[Problem, np.ndarray, float, Deadline], np.ndarray]
