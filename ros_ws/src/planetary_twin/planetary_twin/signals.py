"""
SIGINT and SIGTERM: they interrupt what has nothing to lose, and otherwise only end the spinning.

rclpy's own handlers shut ROS down, which ends what spins; the ones here are called after them.
"""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from planetary_twin_py.cli._interrupts import repeat_lost, repeat_no_more

_NUMBERS = (signal.SIGINT, signal.SIGTERM)


class Signals:
    """Whether the process has been told to end, however often."""

    def __init__(self) -> None:
        self._told = False
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
            if self._told:
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
        first, self._told = not self._told, True
        if self._interrupting and (first or number == signal.SIGALRM):
            raise KeyboardInterrupt


SIGNALS = Signals()
"""Of this process."""
