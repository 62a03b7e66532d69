"""How fast a scene runs: simulated over processor time, the median of a few rounds."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from statistics import median
from typing import NamedTuple, Self

import numpy as np

from planetary_twin_py.run import start
from planetary_twin_py.scene import Scene
from planetary_twin_py.simulation import simulate

METHOD = "march"  # every mesh cycle is computed
SAMPLE_RATE = 50_000.0
ROUNDS = 3  # timed runs, of which the median counts
ROUND = 0.1  # [s] that one of them takes, about


class Speed(NamedTuple):
    """Simulated over computing time, of some rounds."""

    median: float
    low: float  # the slowest
    high: float  # the fastest

    @classmethod
    def of(cls, rounds: Sequence[float]) -> Self:
        """What the rounds come to."""
        return cls(median(rounds), min(rounds), max(rounds))


class Run(NamedTuple):
    """What one run gave and took."""

    mesh: np.ndarray  # (samples, QUANTITIES, meshes)
    seconds: float  # processor time of the run in its thread
    setup_s: float  # wall time of building and starting the model


def run(scene: Scene, duration: float, method: str, tolerance: float, *, sampled: bool) -> Run:
    """Run a scene from its start for `duration` [s], with samples of all meshes or without."""
    begin = time.perf_counter()
    engine = start(scene, tolerance, method)
    setup = time.perf_counter() - begin
    room = round(duration * SAMPLE_RATE) if sampled else 0
    # Not of the process: threads of the linear algebra wait actively for a while after their work.
    begin = time.thread_time()
    samples = engine.advance(duration, 1, SAMPLE_RATE, room)
    return Run(samples.mesh, time.thread_time() - begin, setup)


def speed(scene: Scene, duration: float, method: str, tolerance: float, *, sampled: bool) -> Speed:
    """Speed of runs of `duration` [s], set-up left out."""
    return _rounds(
        duration,
        lambda: run(scene, duration, method, tolerance, sampled=sampled).seconds,
    )


def end_to_end(scene: Scene, duration: float, tolerance: float) -> Speed:
    """Speed of `simulate` by wall time: set-up, samples and result included."""

    def seconds() -> float:
        begin = time.perf_counter()
        simulate(scene, duration, SAMPLE_RATE, tolerance=tolerance)
        return time.perf_counter() - begin

    return _rounds(duration, seconds)


def repeats(seconds: float, most: int) -> int:
    """How often to run on what took `seconds`, so that it takes about a ROUND."""
    return max(1, min(most, int(ROUND / max(seconds, 1e-6))))


def affordable(scene: Scene, tolerance: float, shortest: float, longest: float) -> float:
    """Duration [s] within these bounds that takes about a ROUND to run."""
    duration = shortest
    while duration < longest:
        seconds = run(scene, duration, METHOD, tolerance, sampled=False).seconds
        if seconds >= 0.5 * ROUND:
            break
        duration = min(4.0 * duration, longest)
    return duration


def _rounds(duration: float, seconds: Callable[[], float]) -> Speed:
    return Speed.of([duration / seconds() for _ in range(ROUNDS)])
