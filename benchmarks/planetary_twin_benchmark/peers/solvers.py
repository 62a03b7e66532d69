"""The peers by name, and a run of one of them."""

from __future__ import annotations

import math
import time
from typing import NamedTuple

import numpy as np

from planetary_twin_py.scene import Scene

from . import cvode, cvode_compiled, cyrk, fixed_step, scipy_solvers
from .problem import Problem, sample_times
from .solver import Deadline, Solver

SOLVERS: dict[str, Solver] = {
    **scipy_solvers.SOLVERS,
    **cvode.SOLVERS,
    **cvode_compiled.SOLVERS,
    **cyrk.SOLVERS,
    **fixed_step.SOLVERS,
}


class Run(NamedTuple):
    """Result and cost of a solver."""

    dte: np.ndarray  # (samples, meshes) [m]
    power_loss: float  # mean over the samples [W]
    seconds: float  # processor time of solving and of these results [s]
    setup_s: float  # wall time of building and starting the model [s]


def run(
    name: str, scene: Scene, duration: float, sample_rate: float, tolerance: float, limit: float
) -> Run:
    """Solve a scene from its start with the peer `name`.

    Args:
        name: one of `SOLVERS`.
        scene: what to solve.
        duration: [s]
        sample_rate: [Hz]
        tolerance: relative, see the file of the peer.
        limit: [s] of computing.

    Raises:
        SolverError: the solver gave up, or took more than `limit`.
    """
    begin = time.perf_counter()
    problem, times = Problem(scene), sample_times(duration, sample_rate)
    setup = time.perf_counter() - begin
    SOLVERS[name](problem, times[:1], tolerance, Deadline(math.inf))  # imports what it needs
    begin = time.thread_time()
    states = SOLVERS[name](problem, times, tolerance, Deadline(limit))
    dte, power_loss = problem.observe(times, states)
    return Run(dte, power_loss, time.thread_time() - begin, setup)
