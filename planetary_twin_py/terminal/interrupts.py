"""Repeats an interrupt that arrives where Python discards exceptions, until it takes effect."""

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
    Raise `KeyboardInterrupt`, as a signal handler; during an import, shortly afterwards.

    An extension module that is being initialised replaces or discards exceptions. Call
    `repeat_lost` first: it installs the handler of the timer that is set here.
    """
    if _importing(frame):
        signal.setitimer(signal.ITIMER_REAL, _SOON)
    else:
        raise KeyboardInterrupt


def repeat_lost(handler: Callable[[int, FrameType | None], Any]) -> None:
    """
    Call the signal handler `handler` again if its `KeyboardInterrupt` is lost.

    Python prints and discards exceptions raised in destructors and in callbacks of weak
    references, which every import has. The handler is then called with `signal.SIGALRM`.
    """

    def hook(lost: Any) -> None:
        if lost.exc_type is KeyboardInterrupt:
            signal.setitimer(signal.ITIMER_REAL, _SOON)
        else:
            sys.__unraisablehook__(lost)

    def repeat(number: int, frame: FrameType | None) -> None:
        if frame is not None and frame.f_code is hook.__code__:  # would be lost here, too
            signal.setitimer(signal.ITIMER_REAL, _SOON)
        else:
            handler(number, frame)

    signal.signal(signal.SIGALRM, repeat)
    sys.unraisablehook = hook


def repeat_no_more() -> None:
    """Ignore the timer at the end of a program, when Python has removed its handlers."""
    signal.signal(signal.SIGALRM, signal.SIG_IGN)


def _importing(frame: FrameType | None) -> bool:
    while frame is not None and frame.f_code.co_filename != _IMPORTS:
        frame = frame.f_back
    return frame is not None
