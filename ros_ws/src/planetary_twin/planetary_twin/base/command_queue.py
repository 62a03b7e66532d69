"""Commands from other threads to the thread that runs a twin or plays a recording."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from functools import partial
from typing import Any

Command = Callable[[], float]


class CommandQueue:
    """
    A first-in, first-out queue of commands; each future returns the instant [s] of execution.

    Consecutive changes between two intervals are merged, and the last value of each name counts:
    they would apply from the same instant, and a flood of them must not delay the twin. `change`
    applies values and returns the instant [s].
    """

    def __init__(self, change: Callable[[Mapping[str, Any]], float]) -> None:
        self._change = change
        self._queue: queue.SimpleQueue[tuple[Command, Future[float]]] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._gathering: tuple[dict[str, Any], Future[float]] | None = None

    def put(self, command: Command) -> Future[float]:
        """Append `command` to the queue."""
        with self._lock:
            self._gathering = None
            return self._append(command)

    def change(self, values: Mapping[str, Any]) -> Future[float]:
        """Append a change to `values`, or merge it with the change that was appended last."""
        with self._lock:
            if self._gathering is None:
                gathered: dict[str, Any] = {}
                self._gathering = gathered, self._append(lambda: self._set(gathered))
            self._gathering[0].update(values)
            return self._gathering[1]

    def execute(self, timeout: float = 0.0) -> list[Callable[[], None]]:
        """
        Execute the queued commands, and return the functions that set their futures.

        If the queue is empty, wait up to `timeout` [s] for a command. An exception of a command
        is set on its future. All exceptions but `ValueError`, a refusal, are also raised.
        """
        answers: list[Callable[[], None]] = []
        for _ in range(max(self._queue.qsize(), 1)):
            try:
                command, future = self._queue.get(timeout=timeout)
            except queue.Empty:
                break
            try:
                answers.append(partial(future.set_result, command()))
            except ValueError as refusal:
                answers.append(partial(future.set_exception, refusal))
            except Exception as defect:
                answers.append(partial(future.set_exception, ValueError(f"stopped: {defect}")))
                for answer in answers:
                    answer()
                raise
        return answers

    def refuse(self, reason: str) -> None:
        """Refuse all queued commands: their futures raise `ValueError` with `reason`."""
        with self._lock:
            self._gathering = None
        while not self._queue.empty():
            _, future = self._queue.get()
            future.set_exception(ValueError(reason))

    def _append(self, command: Command) -> Future[float]:
        future: Future[float] = Future()
        self._queue.put((command, future))
        return future

    def _set(self, gathered: dict[str, Any]) -> float:
        with self._lock:
            if self._gathering is not None and self._gathering[0] is gathered:
                self._gathering = None
        return self._change(gathered)
