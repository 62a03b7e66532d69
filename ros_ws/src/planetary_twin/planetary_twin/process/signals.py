"""
Handlers of SIGINT and SIGTERM, called after those of rclpy.

rclpy's handlers shut down ROS, which ends the executors. The handlers here also interrupt steps
that have no data to save.
"""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from planetary_twin_py.terminal.interrupts import interrupt, repeat_lost, repeat_no_more

_NUMBERS = (signal.SIGINT, signal.SIGTERM)


class Signals:
    """The request to end the process, however many signals repeat it."""

    def __init__(self) -> None:
        self.received = False
        """Whether there has been a signal."""
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
            if self.received:
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
        first, self.received = not self.received, True
        if self._interrupting and (first or number == signal.SIGALRM):
            interrupt(number, frame)


SIGNALS = Signals()
"""The signals of this process."""


def interrupt_on_signals() -> None:
    """Make SIGTERM and SIGHUP end a command as Ctrl-C does."""
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, interrupt)
