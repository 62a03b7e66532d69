"""Simulation of many scenes in threads; the core releases the global interpreter lock."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ..run.result import Result
from ..scene import Scene
from ..scene.given import given_scenes
from ..text.escaping import one_line
from ..text.object_repr import brief_record
from .simulate import check_run, simulate
from .threads import Threads


@dataclass(frozen=True)
class Outcome:
    """Result or error of one scene of a batch."""

    place: int
    """Index of the scene in the batch, from 0."""
    scene: Scene
    """The scene."""
    found: Result | ValueError | ArithmeticError
    """The result, or the error of a failed run."""

    @property
    def result(self) -> Result:
        """The result.

        Raises:
            ValueError: the run failed; the message names the scene and the reason.
        """
        if isinstance(self.found, Result):
            return self.found
        name = one_line(self.scene.name, 100)
        raise ValueError(f"scene {self.place} ({name}): {self.found}") from self.found

    def __repr__(self) -> str:
        """One line; arrays by their shapes."""
        return brief_record(self)


def simulate_many(
    scenes: Iterable[Scene],
    duration: float,
    sample_rate: float = 50_000.0,
    method: str = "auto",
    tolerance: float = 1e-4,
    workers: int | None = None,
) -> Iterator[Outcome]:
    """Simulate many scenes in parallel, each with the same result as `simulate`.

    At most two runs per thread are ahead of the caller, so memory does not grow with the number of
    scenes unless the caller keeps the results. The error of a failed run is its outcome; it does
    not affect other runs.

    Args:
        scenes: the scenes; may be a generator.
        duration: simulated time of each run [s].
        sample_rate: of the results [Hz].
        method: see `simulate`.
        tolerance: relative local error tolerance of the integrator.
        workers: number of threads, at least 1; None is the number of available cores.

    Returns:
        An iterator over the outcomes, in the order of the scenes.

    Raises:
        ValueError: an argument is out of range.
    """
    check_run(duration, sample_rate, method, tolerance)
    threads = Threads(workers)

    def run(task: tuple[int, Scene]) -> Outcome:
        place, scene = task
        try:
            found = simulate(scene, duration, sample_rate, method, tolerance)
        except (ValueError, ArithmeticError) as error:
            return Outcome(place, scene, error)
        return Outcome(place, scene, found)

    return threads.in_order(run, enumerate(given_scenes(scenes)))
