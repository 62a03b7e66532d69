"""Many scenes at once. The kernels release the interpreter lock, so threads use all cores."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass

from .result import Result
from .scene import Scene
from .simulation import check_run, simulate

AHEAD = 2  # runs for each worker that are under way or wait to be taken


@dataclass(frozen=True)
class Outcome:
    """What came of one scene of a batch."""

    place: int
    """Of the scene in the batch, from 0."""
    scene: Scene
    found: Result | ValueError | ArithmeticError
    """The result, or why there is none."""

    @property
    def result(self) -> Result:
        """The result.

        Raises:
            ValueError: there is none; says which scene it is, and why.
        """
        if isinstance(self.found, Result):
            return self.found
        raise ValueError(f"scene {self.place} ({self.scene.name}): {self.found}") from self.found


def simulate_many(
    scenes: Iterable[Scene],
    duration: float,
    sample_rate: float = 50_000.0,
    method: str = "auto",
    tolerance: float = 1e-4,
    workers: int | None = None,
) -> Iterator[Outcome]:
    """Simulate every scene as `simulate` does, to the last bit, in the order of the scenes.

    Outcomes come as they are taken: only a few runs are ahead of the caller, so a thousand scenes
    need no more memory than those few, unless the caller keeps their results. A scene that fails
    has its error as outcome and stops no other.

    Args:
        scenes: what to simulate; may itself come bit by bit.
        duration: simulated time of each [s].
        sample_rate: of the results [Hz].
        method: as of `simulate`.
        tolerance: relative local error of a step.
        workers: threads; as many as the process has cores unless given.

    Raises:
        ValueError: an argument is out of range.
    """
    check_run(duration, sample_rate, method, tolerance)
    if workers is None:
        workers = len(os.sched_getaffinity(0))
    if workers < 1:
        raise ValueError(f"workers = {workers!r}: must be at least 1")

    def run(place: int, scene: Scene) -> Outcome:
        try:
            found = simulate(scene, duration, sample_rate, method, tolerance)
        except (ValueError, ArithmeticError) as error:
            return Outcome(place, scene, error)
        return Outcome(place, scene, found)

    return _in_order(scenes, run, workers)


def _in_order(
    scenes: Iterable[Scene], run: Callable[[int, Scene], Outcome], workers: int
) -> Iterator[Outcome]:
    under_way: deque[Future[Outcome]] = deque()
    pool = ThreadPoolExecutor(workers, "scene")
    try:
        for place, scene in enumerate(scenes):
            if len(under_way) == AHEAD * workers:
                yield under_way.popleft().result()
            under_way.append(pool.submit(run, place, scene))
        while under_way:
            yield under_way.popleft().result()
    finally:
        pool.shutdown(cancel_futures=True)
