"""Speed of a scene: simulated time over processor time, median of several rounds."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Sequence
from statistics import median
from typing import NamedTuple, Self

import numpy as np

from planetary_twin_py.model.clock import TICKS
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.run.window_jobs import run_alone
from planetary_twin_py.run.windows import Windows
from planetary_twin_py.scene import Scene
from planetary_twin_py.simulation.simulate import simulate
from planetary_twin_py.text.warning_types import AccuracyWarning

from .samples import samples_until

METHOD = "march"  # every mesh cycle is computed
SAMPLE_RATE = 50_000.0
ROUNDS = 3  # timed runs; the median is reported
ROUND = 0.1  # [s] approximate duration of one


class Speed(NamedTuple):
    """Simulated time over computing time of several rounds."""

    median: float
    low: float  # the slowest
    high: float  # the fastest

    @classmethod
    def of(cls, rounds: Sequence[float]) -> Self:
        """Median and extremes of `rounds`."""
        return cls(median(rounds), min(rounds), max(rounds))


class Run(NamedTuple):
    """Samples and times of one run."""

    mesh: np.ndarray  # (samples, QUANTITIES, meshes), or empty
    seconds: float  # processor time of the run in its thread
    setup_s: float  # wall time of building and starting the model


def run(scene: Scene, duration: float, method: str, tolerance: float, *, sampled: bool) -> Run:
    """Run a scene from its start for `duration` [s], with samples of all meshes or without."""
    begin = time.perf_counter()
    windows = Windows(scene, tolerance, method)
    engine, setup = windows.run, time.perf_counter() - begin
    room = round(duration * SAMPLE_RATE)
    plan, mesh = windows.plan(round(duration * TICKS), SAMPLE_RATE, sampled=False), np.empty(0)
    # Not of the process: threads of the linear algebra wait actively for a while after their work.
    begin = time.thread_time()
    if not sampled:
        run_alone(windows.jobs(plan))
    elif isinstance(engine, Engine):
        mesh = samples_until(engine, duration, 1, SAMPLE_RATE, room).mesh
    else:
        raise ValueError(f"dynamics = {scene.dynamics!r}: must have steps to be sampled")
    return Run(mesh, time.thread_time() - begin, setup)


def speed(scene: Scene, duration: float, method: str, tolerance: float, *, sampled: bool) -> Speed:
    """Speed of runs of `duration` [s], without set-up."""
    return _rounds(
        duration,
        lambda: run(scene, duration, method, tolerance, sampled=sampled).seconds,
    )


def end_to_end(scene: Scene, duration: float, tolerance: float) -> Speed:
    """Speed of `simulate` by wall time: set-up, samples and result included."""

    def seconds() -> float:
        begin = time.perf_counter()
        with warnings.catch_warnings():
            # Rattle is timed, too; its error is measured and printed beside its speed.
            warnings.simplefilter("ignore", AccuracyWarning)
            simulate(scene, duration, SAMPLE_RATE, tolerance=tolerance)
        return time.perf_counter() - begin

    return _rounds(duration, seconds)


def repeats(seconds: float, most: int) -> int:
    """Number of repetitions of a run of `seconds` that take about a ROUND."""
    return max(1, min(most, int(ROUND / max(seconds, 1e-6))))


def affordable(scene: Scene, tolerance: float, shortest: float, longest: float) -> float:
    """Duration [s] within these bounds that takes about a ROUND to compute."""
    duration = shortest
    while duration < longest:
        seconds = run(scene, duration, METHOD, tolerance, sampled=False).seconds
        if seconds >= 0.5 * ROUND:
            break
        duration = min(4.0 * duration, longest)
    return duration


def _rounds(duration: float, seconds: Callable[[], float]) -> Speed:
    return Speed.of([duration / seconds() for _ in range(ROUNDS)])
