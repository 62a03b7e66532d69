"""Turns of the threads that act on a twin: its own, and those that give it commands."""

from __future__ import annotations

import threading
from collections.abc import Callable


class Turns:
    """
    Lets one thread at a time act on a twin.

    The thread of the twin has the turn, in a `with` statement, except while it rests. Meanwhile
    another thread serves its own command: a change of threads takes longer than a step of 1 ms.
    `serve` executes the commands that wait, and returns whether the twin's thread must continue.
    """

    def __init__(self, serve: Callable[[], bool]) -> None:
        self._serve = serve
        self._turn = threading.Lock()
        self._called = threading.Event()
        self._defect: Exception | None = None
        self.ended = False

    def __enter__(self) -> None:
        self._turn.acquire()

    def __exit__(self, *raised: object) -> None:
        self.ended = True
        self._turn.release()

    def rest(self, longest: float) -> None:
        """
        Give up the turn until `wake`, for `longest` [s] at most.

        Raises the exception of `serve` in another thread, if there was one.
        """
        if longest > 0.0:
            self._turn.release()
            self._called.wait(longest)
            self._turn.acquire()
            self._called.clear()
        if self._defect is not None:
            raise self._defect

    def wake(self) -> None:
        """End the rest of the twin's thread, or its next one."""
        self._called.set()

    def call(self) -> None:
        """Serve the commands that wait, in this thread if the twin's thread rests."""
        if not self._turn.acquire(blocking=False):
            self.wake()
            return
        try:
            if not self.ended and self._serve():
                self.wake()
        except Exception as defect:
            self._defect = defect
            self.wake()
        finally:
            self._turn.release()
