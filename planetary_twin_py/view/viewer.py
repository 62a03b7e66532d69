"""The viewer as a process of our own, which listens on this machine only.

The library's ways to start it listen on every network interface, and its `rerun` command is a
wrapper that leaves the viewer running when it is stopped: so the viewer itself is started.
"""

from __future__ import annotations

import os
import socket
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import IO

import rerun_cli


def has_display() -> bool:
    """Whether there is a screen to open a window on."""
    if sys.platform != "linux":
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def show(rrd: Path) -> int:
    """Show `rrd` in a window and wait until it is closed; returns the viewer's exit code."""
    viewer = start_viewer(free_port(), [str(rrd)])
    try:
        return viewer.wait()
    finally:
        stop_viewer(viewer)


def start_viewer(
    port: int, arguments: Sequence[str], output: IO[bytes] | None = None
) -> subprocess.Popen[bytes]:
    """Start the viewer, listening on `port` of the loopback interface."""
    binary = Path(rerun_cli.__file__).parent / "rerun"
    command = [str(binary), "--bind", "127.0.0.1", "--port", str(port), *arguments]
    # A viewer only, without a first-time greeting, and without a line for each thing it does.
    environment = {"RUST_LOG": "error", **os.environ, "RERUN_APP_ONLY": "true"}
    return subprocess.Popen(command, stdout=output, stderr=output, env=environment)


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
