"""Ctrl-C while the core runs."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from threading import Thread
from typing import TypeVar

Answer = TypeVar("Answer")


def interruptible(task: Callable[[], Answer]) -> Answer:
    """Run `task` in a thread, so that Ctrl-C interrupts the wait for it.

    A run is one call of compiled code, during which Python handles no signals. The thread ends
    with the process.

    Args:
        task: function without arguments.

    Returns:
        The return value of `task`.

    Raises:
        BaseException: the exception of `task`.
    """
    answer: Future[Answer] = Future()

    def work() -> None:
        try:
            answer.set_result(task())
        except BaseException as reason:
            answer.set_exception(reason)

    Thread(target=work, name="task", daemon=True).start()
    return answer.result()
