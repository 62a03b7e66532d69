"""One point of a study, run wherever there is room."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Protocol

from ..scene import Scene
from .measures import Row, measure
from .plan import Point, Settings, told


@dataclass(frozen=True)
class Failure:
    """Why a point has no figures."""

    reason: str


Found = Row | Failure


@dataclass(frozen=True)
class Work:
    """What is done at each point; travels to other processes and machines."""

    scene: Scene
    settings: Settings

    def __call__(self, point: Point) -> Found:
        """The figures of `point`, or why there are none."""
        try:
            return measure(self.scene.replace(**point.changes), self.settings)
        except (ValueError, ArithmeticError) as reason:
            return Failure(f"{told(point.changes)}: {reason}")


class Crew(Protocol):
    """Whoever does the work: `local.Threads` or `cluster.Cluster`."""

    def do(
        self, work: Callable[[Point], Found], points: Iterable[Point]
    ) -> Iterator[tuple[Point, Found]]:
        """Every point with what was found there, as they are done."""
