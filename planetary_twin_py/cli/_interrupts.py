"""Interrupts that fall where Python loses exceptions are made again, until one is heard."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable
from types import FrameType
from typing import Any

_SOON = 0.01  # [s]


def repeat_lost(interrupt: Callable[[int, FrameType | None], Any]) -> None:
    """
    Have the signal handler `interrupt` called again where its `KeyboardInterrupt` is lost.

    Python prints and forgets what is raised in a callback of a weak reference, of which every
    import has some, or in a destructor. The handler is called with `signal.SIGALRM` then.
    """

    def hook(lost: Any) -> None:
        if lost.exc_type is KeyboardInterrupt:
            signal.setitimer(signal.ITIMER_REAL, _SOON)
        else:
            sys.__unraisablehook__(lost)

    def repeat(number: int, frame: FrameType | None) -> None:
        if frame is not None and frame.f_code is hook.__code__:  # it would be lost here too
            signal.setitimer(signal.ITIMER_REAL, _SOON)
        else:
            interrupt(number, frame)

    signal.signal(signal.SIGALRM, repeat)
    sys.unraisablehook = hook


def repeat_no_more() -> None:
    """At the end of a program: Python gives up its handlers before all is over."""
    signal.signal(signal.SIGALRM, signal.SIG_IGN)
