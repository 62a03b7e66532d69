"""Execution of many tasks in a pool: in threads, as the core releases the interpreter lock."""

from __future__ import annotations

import os
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from itertools import islice
from typing import TypeVar

Task = TypeVar("Task")
Answer = TypeVar("Answer")


class Pool(ABC):
    """Runs a function of many tasks in a pool of workers, a few tasks ahead of the caller."""

    ahead = 2
    """Tasks per worker that run or are queued; in order, also those not yet consumed."""

    def run(
        self, work: Callable[[Task], Answer], tasks: Iterable[Task]
    ) -> Iterator[tuple[Task, Answer]]:
        """Yield every task with its result, in order of completion.

        Args:
            work: the function.
            tasks: points of a study, or groups of gearboxes.
        """
        waiting, pool = iter(tasks), self._open()
        running: dict[Future[Answer], Task] = {}
        try:
            while True:
                free = max(self.ahead * self._workers() - len(running), 0)
                for task in islice(waiting, free):
                    running[pool.submit(work, task)] = task
                if not running:
                    return
                for done in wait(running, return_when=FIRST_COMPLETED).done:
                    yield running.pop(done), self._answer(done)
        finally:
            self._close(pool, running)

    def in_order(self, work: Callable[[Task], Answer], tasks: Iterable[Task]) -> Iterator[Answer]:
        """Yield every result, in the order of the tasks.

        Args:
            work: the function.
            tasks: its arguments.
        """
        pending: deque[Future[Answer]] = deque()
        pool = self._open()
        try:
            for task in tasks:
                if len(pending) == self.ahead * self._workers():
                    yield self._answer(pending.popleft())
                pending.append(pool.submit(work, task))
            while pending:
                yield self._answer(pending.popleft())
        finally:
            self._close(pool, pending)

    @abstractmethod
    def _open(self) -> Executor:
        """A pool, which `_close` ends."""

    @abstractmethod
    def _workers(self) -> int:
        """Number of tasks that run at the same time, at least 1."""

    def _answer(self, done: Future[Answer]) -> Answer:
        return done.result()

    def _close(self, pool: Executor, unfinished: Iterable[Future[Answer]]) -> None:
        for future in unfinished:
            future.cancel()
        pool.shutdown()


class Threads(Pool):
    """Threads of this process.

    Args:
        count: number of threads; None is the number of available cores.

    Raises:
        ValueError: `count` is below 1.
    """

    def __init__(self, count: int | None = None) -> None:
        self.count = len(os.sched_getaffinity(0)) if count is None else count
        if self.count < 1:
            raise ValueError(f"workers = {count!r}: must be at least 1")

    def _open(self) -> Executor:
        return ThreadPoolExecutor(self.count, "task")

    def _workers(self) -> int:
        return self.count
