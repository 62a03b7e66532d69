"""Execution in threads of this process; the core releases the global interpreter lock."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from itertools import islice
from typing import TypeVar

Task = TypeVar("Task")
Answer = TypeVar("Answer")
AHEAD = 2  # tasks per thread that run or are queued; in order, also those not yet consumed


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
        self, work: Callable[[Task], Answer], tasks: Iterable[Task]
    ) -> Iterator[tuple[Task, Answer]]:
        """Yield every task with its result, in order of completion.

        Args:
            work: the function.
            tasks: points of a study, or groups of gearboxes.
        """
        waiting = iter(tasks)
        pool = ThreadPoolExecutor(self.count, "task")
        running: dict[Future[Answer], Task] = {}
        try:
            while True:
                for task in islice(waiting, AHEAD * self.count - len(running)):
                    running[pool.submit(work, task)] = task
                if not running:
                    return
                for done in wait(running, return_when=FIRST_COMPLETED).done:
                    yield running.pop(done), done.result()
        finally:
            pool.shutdown(cancel_futures=True)

    def in_order(self, work: Callable[[Task], Answer], tasks: Iterable[Task]) -> Iterator[Answer]:
        """Yield every result, in the order of the tasks.

        Args:
            work: the function.
            tasks: its arguments.
        """
        pending: deque[Future[Answer]] = deque()
        pool = ThreadPoolExecutor(self.count, "task")
        try:
            for task in tasks:
                if len(pending) == AHEAD * self.count:
                    yield pending.popleft().result()
                pending.append(pool.submit(work, task))
            while pending:
                yield pending.popleft().result()
        finally:
            pool.shutdown(cancel_futures=True)
