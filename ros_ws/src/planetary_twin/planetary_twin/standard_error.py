"""A standard error that nobody reads holds up no node."""

from __future__ import annotations

import contextlib
import os
import stat
from collections.abc import Iterator

_NUMBER = 2
_OURS = "/proc/self/fd/2"


@contextlib.contextmanager
def never_waiting() -> Iterator[None]:
    """
    Within, what is logged while the terminal stands still, or a pipe is full, is lost.

    ROS logs with Python's global lock held: who waits there stops every thread of the process.
    All lines are on /rosout as well. The mode is set on an opening of our own: the one that we
    were given is also the shell's. A file never waits, and its place is shared with whoever else
    writes into it; a socket cannot be opened anew: with both nothing changes.
    """
    if not (os.isatty(_NUMBER) or stat.S_ISFIFO(os.fstat(_NUMBER).st_mode)):
        yield
        return
    try:
        ours = os.open(_OURS, os.O_WRONLY | os.O_NONBLOCK | os.O_NOCTTY)
    except OSError:  # a terminal of somebody else
        yield
        return
    given = os.dup(_NUMBER)
    os.dup2(ours, _NUMBER)
    os.close(ours)
    try:
        yield
    finally:
        os.dup2(given, _NUMBER)
        os.close(given)
