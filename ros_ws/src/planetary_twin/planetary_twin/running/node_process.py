"""Nodes as child processes that end with the run, of which a domain and namespace has one."""

from __future__ import annotations

import contextlib
import ctypes
import fcntl
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from typing import Self

from ..process.environment import use_one_thread

_PR_SET_PDEATHSIG = 1  # linux/prctl.h
_TIMEOUT = {signal.SIGINT: 10.0, signal.SIGTERM: 3.0, signal.SIGKILL: 3.0}  # [s]


def _end_with_parent() -> None:
    """Make the kernel send SIGTERM to this process when its parent dies."""
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)


class RunError(RuntimeError):
    """A run cannot continue; the message gives the reason in one line."""


class Child:
    """
    A process with the `node` of this or another `package`, with `parameters` in `namespace`.

    It has its own session: Ctrl-C reaches the run only, which ends its nodes in order.
    """

    def __init__(
        self,
        node: str,
        namespace: str,
        parameters: Mapping[str, object],
        package: str = __package__.partition(".")[0],
    ) -> None:
        self.node = node
        command = [sys.executable, "-m", f"{package}.{node}", "--ros-args"]
        command += ["-r", f"__ns:={namespace}"]
        for name, value in parameters.items():
            command += ["-p", f"{name}:={value}"]
        environment = dict(os.environ)
        use_one_thread(environment)
        self._log = tempfile.TemporaryFile()  # noqa: SIM115 (closed with the child)
        self._process = subprocess.Popen(
            command,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=self._log,
            stderr=self._log,
            start_new_session=True,
            preexec_fn=_end_with_parent,  # no thread runs yet
        )

    @property
    def pid(self) -> int:
        """Id of the process."""
        return self._process.pid

    @property
    def returncode(self) -> int | None:
        """Exit code; None while the process runs."""
        return self._process.poll()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *raised: object) -> None:
        self.stop()
        self._log.close()

    def check(self) -> None:
        """Raise `RunError` if the process has ended."""
        code = self.returncode
        if code is None:
            return
        if code < 0:
            raise RunError(f"{self.node}: ended by {signal.Signals(-code).name}")
        raise RunError(self.last_line() or f"{self.node}: ended with exit code {code}")

    def stop(self) -> int:
        """End the process with SIGINT, then SIGTERM, then SIGKILL; returns its exit code."""
        for number, timeout in _TIMEOUT.items():
            if self._process.poll() is None:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(self._process.pid, number)
                with contextlib.suppress(subprocess.TimeoutExpired):
                    self._process.wait(timeout)
        return self._process.returncode

    def output(self) -> str:
        """Return the output of the process."""
        self._log.seek(0)
        return self._log.read().decode(errors="replace")

    def last_line(self) -> str:
        """Return the last line of the output; empty without one."""
        lines = self.output().strip().splitlines()
        return lines[-1] if lines else ""

    def last_error(self) -> str:
        """Return the last error that the node logged; empty without one."""
        lines = [line for line in self.output().splitlines() if line.startswith("[ERROR]")]
        return lines[-1].partition("]: ")[2] if lines else ""


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
