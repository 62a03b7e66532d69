"""Evaluation of one point of a study, and the interface of executors."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Protocol, TypeVar

from ..scene import Scene
from ..simulation.figures import Row
from .measures import measure
from .plan import Point, Settings, describe

Task = TypeVar("Task")
Answer = TypeVar("Answer")


@dataclass(frozen=True)
class Failure:
    """Why a point has no results."""

    reason: str


Found = Row | Failure
Report = Callable[[int, Failure | None], None]
"""Called with the number of points completed since the last call, and the failure of one."""


@dataclass(frozen=True)
class Evaluation:
    """Evaluates the run at a point; it is pickled for other processes."""

    scene: Scene
    settings: Settings

    def __call__(self, point: Point) -> Found:
        """Results of the run at `point`, or the failure."""
        try:
            return measure(self.scene.replace(**point.changes), self.settings)
        except (ValueError, ArithmeticError) as reason:
            return Failure(f"{describe(point.changes)}: {reason}")


class Executor(Protocol):
    """Runs a function of many tasks: `Threads` or `Cluster`."""

    def run(
        self, work: Callable[[Task], Answer], tasks: Iterable[Task]
    ) -> Iterator[tuple[Task, Answer | Failure]]:
        """Yield every task with its result, in order of completion.

        Args:
            work: the function.
            tasks: points of a study, or groups of gearboxes.
        """
