"""Starts the viewer as a child process that accepts connections from this machine only.

The functions of the library accept connections on every network interface, and the `rerun` command
is a wrapper that leaves the viewer running when it is stopped, so the binary is started directly.
"""

from __future__ import annotations

import json
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
from functools import cache
from pathlib import Path
from typing import IO
from urllib.parse import quote

import rerun_cli

from .own_page import served

BINARY = Path(rerun_cli.__file__).parent / "rerun"
_PORTS = (9090, 9091)  # of the page and of its data; constant, so that they can be forwarded
_ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
_TIMEOUT = 20.0  # [s] until the page and the data are served


class ViewerError(RuntimeError):
    """The viewer failed; the message gives the reason in one line."""


def has_display() -> bool:
    """Whether there is a display for a window."""
    if sys.platform != "linux":
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


@dataclass(frozen=True)
class Viewer:
    """A running viewer."""

    process: subprocess.Popen[bytes]
    data: int
    """Port that receives data."""
    page: int | None = None
    """Port of the web page; None for a window."""

    @property
    def url(self) -> str:
        """URL to which data are logged."""
        return f"rerun+http://127.0.0.1:{self.data}/proxy"

    @property
    def address(self) -> str:
        """Address to open in a browser."""
        return f"http://127.0.0.1:{self.page}/?url={quote(self.url, safe='')}"


@contextmanager
def window(*arguments: str) -> Iterator[Viewer]:
    """Context with a viewer in a window; `arguments` are those of the binary."""
    with _started(Viewer(start_viewer(port := free_port(), arguments), port)) as viewer:
        yield viewer


@contextmanager
def page(*arguments: str) -> Iterator[Viewer]:
    """Context with a viewer for a browser, on constant ports if they are free.

    The page sends no requests to other hosts.

    Args:
        arguments: arguments of the binary.

    Raises:
        ViewerError: the page cannot be served.
    """
    shown, data = (free_port() if _answers(port) else port for port in _PORTS)
    origin = free_port()
    options = ["--serve-web", "--web-viewer-port", str(origin), *arguments]
    with (
        tempfile.TemporaryFile() as output,
        _started(Viewer(start_viewer(data, options, output), data, shown)) as viewer,
        served(shown, origin, data),
    ):
        deadline = time.monotonic() + _TIMEOUT
        while not (_answers(origin) and _answers(data)):
            if time.monotonic() > deadline or viewer.process.poll() is not None:
                raise ViewerError(f"the page cannot be served: {last_line(output)}")
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
    """Leave the context normally on Ctrl-C, SIGTERM or SIGHUP."""
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
    """Start the viewer.

    Args:
        port: port of the loopback interface that receives data.
        arguments: arguments of the binary.
        output: file for its output; None inherits that of this process.

    Returns:
        The process.
    """
    command = [str(BINARY), "--bind", "127.0.0.1", "--port", str(port), *arguments]
    # Without the first-time welcome and without informational log lines.
    environment = {"RUST_LOG": "error", **private_environment(), "RERUN_APP_ONLY": "true"}
    # In a separate session: Ctrl-C reaches only this process, which then stops the viewer.
    return subprocess.Popen(
        command, stdout=output, stderr=output, env=environment, start_new_session=True
    )


def private_environment() -> dict[str, str]:
    """Environment in which Rerun collects no usage data and writes nothing to the home folder.

    `rerun analytics disable` writes its choice to the configuration of the user, and there is no
    variable for it. So this process has a temporary configuration with the same choice.
    """
    return {**os.environ, "XDG_CONFIG_HOME": _configuration().name}


@cache
def _configuration() -> tempfile.TemporaryDirectory[str]:
    folder = tempfile.TemporaryDirectory(prefix="planetary_twin_rerun_")
    file = Path(folder.name, "rerun", "analytics.json")
    file.parent.mkdir()
    choice = {
        "analytics_enabled": False,
        "analytics_id": "",
        "metadata": {},
        "config_file_path": str(file),
        "data_dir_path": str(file.parent),
    }
    file.write_text(json.dumps(choice), encoding="utf-8")
    return folder


def stop_viewer(viewer: subprocess.Popen[bytes]) -> None:
    """Stop the viewer if it is running."""
    viewer.terminate()
    try:
        viewer.wait(5.0)
    except subprocess.TimeoutExpired:
        viewer.kill()
        viewer.wait()


def free_port() -> int:
    """A free TCP port of the loopback interface."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def last_line(output: IO[bytes]) -> str:
    """The last non-empty line of `output`."""
    output.seek(0)
    lines = [line for line in output.read().decode(errors="replace").splitlines() if line.strip()]
    return lines[-1] if lines else "it printed nothing"


def _answers(port: int) -> bool:
    """Whether a port of the loopback interface accepts connections."""
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0
