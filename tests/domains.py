"""DDS domains that no other test uses, in this process or another, of this clone or another."""

import fcntl
import os
import socket
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

# Ports of a domain begin at 7400 + 250 x its number: those of 101 lie below what Linux gives out.
DOMAINS = 101
_PORTS, _PER_DOMAIN = 7400, 250


@contextmanager
def private_domain() -> Iterator[int]:
    """
    Hold a domain on which nobody is for as long as the context lasts.

    The kernel lets go of the lock when the process that holds it ends, however it ends. Nodes that
    such a process leaves behind keep their domain from being used. Raises `RuntimeError` where
    tests of others hold all domains.
    """
    for count in range(DOMAINS):
        number = 1 + (os.getpid() + count) % DOMAINS
        if (lock := _locked(number)) is None:
            continue
        if _empty(number):
            break
        os.close(lock)
    else:
        raise RuntimeError(f"all {DOMAINS} DDS domains are held by other tests")
    try:
        yield number
    finally:
        os.close(lock)


def _locked(number: int) -> int | None:
    """Return a descriptor that holds the domain, or None where another process holds it."""
    path = Path(tempfile.gettempdir()) / f"planetary_twin_test_domain_{number}.lock"
    try:
        # Linux refuses to create what is there and belongs to another user.
        lock = os.open(path, os.O_RDWR if path.exists() else os.O_RDWR | os.O_CREAT, 0o666)
    except PermissionError:
        return None
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(lock)
        return None
    return lock


def _empty(number: int) -> bool:
    """Return whether no participant listens on the multicast port of the domain."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as port:
        try:
            port.bind(("", _PORTS + _PER_DOMAIN * number))
        except OSError:
            return False
    return True
