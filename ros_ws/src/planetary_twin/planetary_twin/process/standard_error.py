"""Makes writes to standard error non-blocking, so that a stalled reader delays no node."""

from __future__ import annotations

import contextlib
import os
import stat
from collections.abc import Iterator

_NUMBER = 2
_PATH = "/proc/self/fd/2"


@contextlib.contextmanager
def nonblocking_stderr() -> Iterator[None]:
    """
    In the block, log lines are discarded while the terminal is stopped or a pipe is full.

    ROS logs while it holds Python's global lock, so a blocked write would stop every thread of the
    process. All lines are also published on /rosout. The mode is set on a new file description,
    because the inherited one is shared with the shell. Files and sockets are left as they are: a
    file never blocks and its offset is shared with other writers; a socket cannot be reopened.
    Without this, tests/ros/process/test_standard_error.py fails.
    """
    if not (os.isatty(_NUMBER) or stat.S_ISFIFO(os.fstat(_NUMBER).st_mode)):
        yield
        return
    try:
        own = os.open(_PATH, os.O_WRONLY | os.O_NONBLOCK | os.O_NOCTTY)
    except OSError:  # a terminal of another user
        yield
        return
    given = os.dup(_NUMBER)
    os.dup2(own, _NUMBER)
    os.close(own)
    try:
        yield
    finally:
        os.dup2(given, _NUMBER)
        os.close(given)
