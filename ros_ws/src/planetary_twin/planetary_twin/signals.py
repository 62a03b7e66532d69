"""
SIGINT and SIGTERM: they interrupt what has nothing to lose, and otherwise only end the spinning.

rclpy's own handlers shut ROS down, which ends what spins; the ones here are called after them.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from planetary_twin_py.cli._interrupts import interrupt, repeat_lost, repeat_no_more

_NUMBERS = (signal.SIGINT, signal.SIGTERM)


class Signals:
    """Whether the process has been told to end, however often."""

    def __init__(self) -> None:
        self.told = threading.Event()
        """To end."""
        self._interrupting = False

    def listen(self) -> None:
        """Take the signals; before `rclpy.init`, which hands them on to who had them before."""
        for number in _NUMBERS:
            signal.signal(number, self._tell)
        repeat_lost(self._tell)

    @contextmanager
    def interrupting(self) -> Iterator[None]:
        """Raise `KeyboardInterrupt` at the first signal within, or at once if it has come."""
        self._interrupting = True
        try:
            if self.told.is_set():
                raise KeyboardInterrupt
            yield
        finally:
            self._interrupting = False

    def ignore(self) -> None:
        """Let no signal disturb the interpreter's end."""
        for number in _NUMBERS:
            signal.signal(number, signal.SIG_IGN)
        repeat_no_more()

    def _tell(self, number: int, frame: FrameType | None) -> None:
        first = not self.told.is_set()
        self.told.set()
        if self._interrupting and (first or number == signal.SIGALRM):
            interrupt(number, frame)


SIGNALS = Signals()
"""Of this process."""
