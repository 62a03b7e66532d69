"""One run at a time in a domain and namespace."""

from __future__ import annotations

import contextlib
import fcntl
import os
import tempfile
from collections.abc import Iterator

from .node_process import RunError


def conflict(others: str = "another twin") -> str:
    """Return the line of a refusal: `others` publish here."""
    return f"{others} runs on ROS_DOMAIN_ID = {_domain()}: end it, or choose another domain"


@contextlib.contextmanager
def alone(namespace: str) -> Iterator[None]:
    """
    Raise `RunError` if another run of this user is active in the same domain and namespace.

    A lock is used because discovery may take longer than a short run; it ends with its process.
    """
    name = f"planetary_twin_{os.getuid()}_{_domain()}{namespace.replace('/', '_')}.lock"
    path = os.path.join(tempfile.gettempdir(), name)
    lock = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o600)
    try:
        _lock(lock)
        yield
    finally:
        os.close(lock)


def _domain() -> str:
    return os.environ.get("ROS_DOMAIN_ID", "0")


def _lock(lock: int) -> None:
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise RunError(conflict()) from None
