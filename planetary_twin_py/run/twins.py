"""Many simulations that advance together in windows, on all cores."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType

from ..scene import Scene
from ..scene.given import given_scenes
from ..text.object_repr import brief
from .limits import RunawayError
from .tolerance import LIVE_TOLERANCE
from .twin import Twin
from .window import Window
from .window_jobs import run_together


class Twins:
    """Running gearboxes, each with a scene of its own, that advance together.

    One call of `advance` computes the windows of all copies in threads of the compiled core,
    without the global interpreter lock. Each copy is a `Twin`, and its results are those of a
    `Twin` that runs alone, to the last bit, with any number of threads. Quasi-static copies are
    computed one after another.

    Inputs of a copy are changed through it: `twins[3].set(backlash=2e-7)`.

    Args:
        scenes: one scene for each copy.
        sample_rate: of the waveforms [Hz]; a low rate saves time where only statistics are needed.
        tolerance: relative local error tolerance; the default is suitable for real time.
        workers: number of threads, at least 1; None is the number of available cores.

    Raises:
        ValueError: a scene, the sample rate, the tolerance or the number of threads is invalid.
    """

    def __init__(
        self,
        scenes: Iterable[Scene],
        sample_rate: float = 50_000.0,
        tolerance: float = LIVE_TOLERANCE,
        workers: int | None = None,
    ) -> None:
        if workers is None:
            workers = len(os.sched_getaffinity(0))
        if workers < 1:
            raise ValueError(f"workers = {workers!r}: must be at least 1")
        self._workers = workers
        self._twins = [Twin(scene, sample_rate, tolerance) for scene in given_scenes(scenes)]
        self._failures: dict[int, RunawayError] = {}

    def __len__(self) -> int:
        """Number of copies."""
        return len(self._twins)

    def __getitem__(self, place: int) -> Twin:
        """The copy at a place, from 0 on."""
        return self._twins[place]

    def __iter__(self) -> Iterator[Twin]:
        """All copies, in the order of the scenes."""
        return iter(self._twins)

    @property
    def failures(self) -> Mapping[int, RunawayError]:
        """Errors of copies whose runs exceeded physical limits, by place."""
        return MappingProxyType(self._failures)

    def advance(self, duration: float) -> list[Window | None]:
        """Simulate one window of every copy.

        A copy that fails does not affect the others: its error is in `failures`, and it is left
        out from then on.

        Args:
            duration: simulated time [s], see `Twin.advance`.

        Returns:
            Statistics and waveform of the window of each copy, (copies,); None for a failed copy.

        Raises:
            ValueError: the duration is out of range; no copy has advanced.
        """
        running = [place for place in range(len(self)) if place not in self._failures]
        plans = {place: self._twins[place]._plan(duration) for place in running}
        for place, plan in plans.items():
            self._twins[place]._begin(plan)
        jobs = [self._twins[place]._jobs(plan) for place, plan in plans.items()]
        for n, error in run_together(jobs, self._workers).items():
            self._failures[running[n]] = error
        return [
            None if place in self._failures else self._twins[place]._close(plans[place])
            for place in range(len(self))
        ]

    def __repr__(self) -> str:
        """One line."""
        return brief(self, f"{len(self)} copies", f"{len(self._failures)} failed")
