"""What every peer is: a function that solves a `Problem` and keeps to a limit of time."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from .problem import Problem


class SolverError(Exception):
    """A solver gave up, for the reason given."""


class TooSlow(SolverError):
    """A solver's time was up."""


class Deadline:
    """A limit of time, at which whoever solves looks now and then."""

    def __init__(self, seconds: float) -> None:
        self._seconds, self._end = seconds, time.monotonic() + seconds

    def check(self) -> None:
        """Raises TooSlow once the time is up."""
        if time.monotonic() > self._end:
            raise TooSlow(f"over {self._seconds:g} s")


# (problem, sample times [s], relative tolerance, deadline) -> states (samples, size) at the times.
Solver = Callable[[Problem, np.ndarray, float, Deadline], np.ndarray]
