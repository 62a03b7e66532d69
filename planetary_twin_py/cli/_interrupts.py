"""Interrupts that fall where exceptions are lost are made again, until one is heard."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable
from types import FrameType
from typing import Any

_SOON = 0.01  # [s]
_IMPORTS = "<frozen importlib._bootstrap>"


def interrupt(number: int, frame: FrameType | None) -> None:
    """
    Raise `KeyboardInterrupt`, as a signal handler; while a module is imported, soon after.

    An extension module that is being made answers exceptions with others, or forgets them. It
    takes `repeat_lost` to have it called again.
    """
    if _importing(frame):
        signal.setitimer(signal.ITIMER_REAL, _SOON)
    else:
        raise KeyboardInterrupt


def repeat_lost(handler: Callable[[int, FrameType | None], Any]) -> None:
    """
    Have the signal handler `handler` called again where its `KeyboardInterrupt` is lost.

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
            handler(number, frame)

    signal.signal(signal.SIGALRM, repeat)
    sys.unraisablehook = hook


def repeat_no_more() -> None:
    """At the end of a program: Python gives up its handlers before all is over."""
    signal.signal(signal.SIGALRM, signal.SIG_IGN)


def _importing(frame: FrameType | None) -> bool:
    while frame is not None and frame.f_code.co_filename != _IMPORTS:
        frame = frame.f_back
    return frame is not None
