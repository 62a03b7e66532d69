"""Ctrl-C while a kernel runs."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from threading import Thread
from typing import TypeVar

Answer = TypeVar("Answer")


def interruptible(task: Callable[[], Answer]) -> Answer:
    """Return what `task` returns, or raise what it raises; Ctrl-C ends the wait for it at once.

    A whole run is one call of compiled code, in which Python takes no signal: it has a thread of
    its own, which ends with the process.
    """
    answer: Future[Answer] = Future()

    def work() -> None:
        try:
            answer.set_result(task())
        except BaseException as reason:
            answer.set_exception(reason)

    Thread(target=work, name="task", daemon=True).start()
    return answer.result()
