"""Execution in threads of this process; the core releases the global interpreter lock."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from itertools import islice
from typing import TypeVar

Task = TypeVar("Task")
Answer = TypeVar("Answer")
AHEAD = 2  # points per thread that run or are queued


class Threads:
    """A pool of threads.

    Args:
        count: number of threads; None is the number of available cores.

    Raises:
        ValueError: `count` is below 1.
    """

    def __init__(self, count: int | None = None) -> None:
        self.count = len(os.sched_getaffinity(0)) if count is None else count
        if self.count < 1:
            raise ValueError(f"workers = {count!r}: must be at least 1")

    def run(
        self, work: Callable[[Task], Answer], points: Iterable[Task]
    ) -> Iterator[tuple[Task, Answer]]:
        """Yield every point with its result, in order of completion.

        Args:
            work: function to evaluate at each point.
            points: points of the study.
        """
        waiting = iter(points)
        pool = ThreadPoolExecutor(self.count, "point")
        running: dict[Future[Answer], Task] = {}
        try:
            while True:
                for point in islice(waiting, AHEAD * self.count - len(running)):
                    running[pool.submit(work, point)] = point
                if not running:
                    return
                for done in wait(running, return_when=FIRST_COMPLETED).done:
                    yield running.pop(done), done.result()
        finally:
            pool.shutdown(cancel_futures=True)
