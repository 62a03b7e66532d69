"""Points on this machine: the kernels release the interpreter lock, so threads use all cores."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from itertools import islice
from typing import TypeVar

Task = TypeVar("Task")
Answer = TypeVar("Answer")
AHEAD = 2  # points for each worker that are under way or wait for their turn


class Threads:
    """Workers of this process; as many as it has cores unless `count` is given.

    Raises:
        ValueError: `count` is below 1.
    """

    def __init__(self, count: int | None = None) -> None:
        self.count = len(os.sched_getaffinity(0)) if count is None else count
        if self.count < 1:
            raise ValueError(f"workers = {count!r}: must be at least 1")

    def do(
        self, work: Callable[[Task], Answer], points: Iterable[Task]
    ) -> Iterator[tuple[Task, Answer]]:
        """Every point with what was found there, as they are done."""
        waiting = iter(points)
        pool = ThreadPoolExecutor(self.count, "point")
        under_way: dict[Future[Answer], Task] = {}
        try:
            while True:
                for point in islice(waiting, AHEAD * self.count - len(under_way)):
                    under_way[pool.submit(work, point)] = point
                if not under_way:
                    return
                for done in wait(under_way, return_when=FIRST_COMPLETED).done:
                    yield under_way.pop(done), done.result()
        finally:
            pool.shutdown(cancel_futures=True)
