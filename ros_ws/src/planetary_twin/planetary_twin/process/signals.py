"""
Handlers of SIGINT and SIGTERM, called after those of rclpy.

rclpy's handlers shut down ROS, which ends the executors. The handlers here also interrupt steps
that have no data to save.
"""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from queue import SimpleQueue
from types import FrameType

from planetary_twin_py.terminal.interrupts import interrupt, repeat_lost, repeat_no_more

_NUMBERS = (signal.SIGINT, signal.SIGTERM)


class Stop:
    """
    A request to stop that a signal handler may make while it interrupts another one.

    An `Event` would deadlock there, because its lock is not reentrant; `SimpleQueue.put` is
    (tests/ros/process/test_signals.py).
    """

    def __init__(self) -> None:
        self._requests: SimpleQueue[None] = SimpleQueue()
        self._made = False

    def set(self) -> None:
        """Make the request."""
        self._made = True
        self._requests.put(None)

    def is_set(self) -> bool:
        """Whether the request has been made."""
        return self._made

    def wait(self) -> None:
        """Wait until the request has been made."""
        self._requests.get()
        self._requests.put(None)  # for other threads that wait


class Signals:
    """The request to end the process, however many signals repeat it."""

    def __init__(self) -> None:
        self.stop = Stop()
        """Set at the first signal, or when the process ends by itself."""
        self._interrupting = False

    def install(self) -> None:
        """Install the handlers; before `rclpy.init`, whose handlers then call them."""
        for number in _NUMBERS:
            signal.signal(number, self._on_signal)
        repeat_lost(self._on_signal)

    @contextmanager
    def interrupting(self) -> Iterator[None]:
        """Raise `KeyboardInterrupt` in the block at the first signal, or at once after one."""
        self._interrupting = True
        try:
            if self.stop.is_set():
                raise KeyboardInterrupt
            yield
        finally:
            self._interrupting = False

    def ignore(self) -> None:
        """Ignore signals while the interpreter ends."""
        for number in _NUMBERS:
            signal.signal(number, signal.SIG_IGN)
        repeat_no_more()

    def _on_signal(self, number: int, frame: FrameType | None) -> None:
        first = not self.stop.is_set()
        self.stop.set()
        if self._interrupting and (first or number == signal.SIGALRM):
            interrupt(number, frame)


SIGNALS = Signals()
"""The signals of this process."""


def interrupt_on_signals() -> None:
    """Make SIGTERM and SIGHUP end a command as Ctrl-C does."""
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, interrupt)
