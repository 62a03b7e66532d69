"""What a thread that runs a twin or plays a tape is told by others, and does in between."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from functools import partial
from typing import Any

Order = Callable[[], float]
_PATIENCE = 60.0  # [s] longest wait for an order to be carried out


class Orders:
    """
    Carried out in the order given; each future is the instant [s] of that.

    Changes that follow one another between two intervals become one, of what was given last: they
    would hold from the same instant, and a flood of them must not hold the twin up.
    """

    def __init__(self, change: Callable[[Mapping[str, float]], float]) -> None:
        self._change = change
        self._queue: queue.SimpleQueue[tuple[Order, Future[float]]] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._gathering: tuple[dict[str, float], Future[float]] | None = None

    def give(self, order: Order) -> Future[float]:
        """Have `order` carried out after what was given before."""
        with self._lock:
            self._gathering = None
            return self._put(order)

    def change(self, values: Mapping[str, float]) -> Future[float]:
        """Have `values` set."""
        with self._lock:
            if self._gathering is None:
                gathered: dict[str, float] = {}
                self._gathering = gathered, self._put(lambda: self._set(gathered))
            self._gathering[0].update(values)
            return self._gathering[1]

    def carry_out(self, patience: float) -> list[Callable[[], None]]:
        """
        Do what is there by now, and return what gives the answers.

        Where nothing is there, wait `patience` [s] for one order. What an order raises goes to
        who gave it; all but a `ValueError`, a refusal, is also raised.
        """
        answers: list[Callable[[], None]] = []
        for _ in range(max(self._queue.qsize(), 1)):
            try:
                order, future = self._queue.get(timeout=patience)
            except queue.Empty:
                break
            try:
                answers.append(partial(future.set_result, order()))
            except ValueError as refusal:
                answers.append(partial(future.set_exception, refusal))
            except Exception as defect:
                answers.append(partial(future.set_exception, ValueError(f"stopped: {defect}")))
                for answer in answers:
                    answer()
                raise
        return answers

    def refuse(self, reason: str) -> None:
        """Answer all that is left with `reason`."""
        with self._lock:
            self._gathering = None
        while not self._queue.empty():
            _, future = self._queue.get()
            future.set_exception(ValueError(reason))

    def _put(self, order: Order) -> Future[float]:
        future: Future[float] = Future()
        self._queue.put((order, future))
        return future

    def _set(self, gathered: dict[str, float]) -> float:
        with self._lock:
            if self._gathering is not None and self._gathering[0] is gathered:
                self._gathering = None
        return self._change(gathered)


def answer(response: Any, order: Callable[[], Future[float]], told: Callable[[float], str]) -> Any:
    """Fill in what came of an order: `told` turns its instant [s] into the message."""
    try:
        response.message = told(order().result(timeout=_PATIENCE))
        response.success = True
    except (ValueError, TimeoutError) as refusal:
        response.success, response.message = False, str(refusal)
    return response
