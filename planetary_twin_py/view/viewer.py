"""The viewer as a process of our own, which listens on this machine only.

The library's ways to start it listen on every network interface, and its `rerun` command is a
wrapper that leaves the viewer running when it is stopped: so the viewer itself is started.
"""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO
from urllib.parse import quote

import rerun_cli

from .own_page import served

_PORTS = (9090, 9091)  # of the page and of its data, for those who forward them
_ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
_PATIENCE = 20.0  # [s] longest wait for the page and the data to be served


class ViewerError(RuntimeError):
    """The viewer does not do what it is for; the message says why in one line."""


def has_display() -> bool:
    """Whether there is a screen to open a window on."""
    if sys.platform != "linux":
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


@dataclass(frozen=True)
class Viewer:
    """A viewer that runs: what it takes data from, and the page it shows in a browser if any."""

    process: subprocess.Popen[bytes]
    data: int
    """Port to log to."""
    page: int | None = None
    """Port of the page."""

    @property
    def url(self) -> str:
        """Where to log to."""
        return f"rerun+http://127.0.0.1:{self.data}/proxy"

    @property
    def address(self) -> str:
        """What to open in a browser."""
        return f"http://127.0.0.1:{self.page}/?url={quote(self.url, safe='')}"


@contextmanager
def window(*arguments: str) -> Iterator[Viewer]:
    """A viewer in a window of its own, ended at the end of the context."""
    with _started(Viewer(start_viewer(port := free_port(), arguments), port)) as viewer:
        yield viewer


@contextmanager
def page(*arguments: str) -> Iterator[Viewer]:
    """A viewer in a browser, on ports that stay the same as long as they are free.

    The page asks nothing of other hosts.

    Raises:
        ViewerError: what the viewer says where it cannot be.
    """
    shown, data = (free_port() if _answers(port) else port for port in _PORTS)
    origin = free_port()
    options = ["--serve-web", "--web-viewer-port", str(origin), *arguments]
    with (
        tempfile.TemporaryFile() as output,
        _started(Viewer(start_viewer(data, options, output), data, shown)) as viewer,
        served(shown, origin, data),
    ):
        deadline = time.monotonic() + _PATIENCE
        while not (_answers(origin) and _answers(data)):
            if time.monotonic() > deadline or viewer.process.poll() is not None:
                raise ViewerError(f"the page cannot be served: {last_words(output)}")
            time.sleep(0.1)
        yield viewer


@contextmanager
def _started(viewer: Viewer) -> Iterator[Viewer]:
    try:
        yield viewer
    finally:
        stop_viewer(viewer.process)


@contextmanager
def until_interrupted() -> Iterator[None]:
    """Leave the context at Ctrl-C, SIGTERM or SIGHUP, as if it had come to its end."""
    before = {number: signal.signal(number, signal.default_int_handler) for number in _ENDING}
    try:
        with suppress(KeyboardInterrupt):
            yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def start_viewer(
    port: int, arguments: Sequence[str], output: IO[bytes] | None = None
) -> subprocess.Popen[bytes]:
    """Start the viewer, listening on `port` of the loopback interface."""
    binary = Path(rerun_cli.__file__).parent / "rerun"
    command = [str(binary), "--bind", "127.0.0.1", "--port", str(port), *arguments]
    # A viewer only, without a first-time greeting, and without a line for each thing it does.
    environment = {"RUST_LOG": "error", **os.environ, "RERUN_APP_ONLY": "true"}
    # In a session of its own: Ctrl-C reaches only who started it, who ends it in order.
    return subprocess.Popen(
        command, stdout=output, stderr=output, env=environment, start_new_session=True
    )


def stop_viewer(viewer: subprocess.Popen[bytes]) -> None:
    """End the viewer if it still runs."""
    viewer.terminate()
    try:
        viewer.wait(5.0)
    except subprocess.TimeoutExpired:
        viewer.kill()
        viewer.wait()


def free_port() -> int:
    """A TCP port of the loopback interface that nothing listens on."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def last_words(output: IO[bytes]) -> str:
    """The last line that the viewer printed."""
    output.seek(0)
    lines = [line for line in output.read().decode(errors="replace").splitlines() if line.strip()]
    return lines[-1] if lines else "it printed nothing"


def _answers(port: int) -> bool:
    """Whether something listens on a port of the loopback interface."""
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0
