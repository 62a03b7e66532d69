"""A picture of a recording, rendered by the viewer without display or graphics card.

The viewer runs without a window, and accepts connections from this machine only.
"""

from __future__ import annotations

import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

from rerun.experimental import ViewerClient

from .timeline import SIMULATED_TIME
from .viewer import ViewerError, free_port, last_line, start_viewer, stop_viewer

_SIZE = "1920x1080"  # pixels
_START_LIMIT = 30.0  # [s] a cold start with a software renderer takes 2 to 5 s
_NOTICES = 4.0  # [s] until start-up notifications, shown for 2 to 3 s, have disappeared
_SETTLE_LIMIT = 30.0  # [s] until all curves and solids are loaded, which takes 1 to 3 s
_END_LIMIT = 5.0  # [s] for a viewer that fails to print why


class ScreenshotError(ViewerError):
    """The viewer could not make a picture; the message says why in one line."""


def save_screenshot(rrd: Path, png: Path, at: float | None = None) -> None:
    """Save a picture of a Rerun file.

    Args:
        rrd: Rerun file.
        png: file to write.
        at: position of the time cursor [s of simulated time]; None is the default of the viewer.

    Raises:
        ScreenshotError: the viewer does not start, for example without a Vulkan driver.
    """
    with _headless_viewer() as client:
        client.open(str(rrd.resolve()))
        if at is not None:
            client.set_time(SIMULATED_TIME, duration=at, play_state="paused")
        time.sleep(_NOTICES)
        picture = _settled_picture(client)
    png.write_bytes(picture)


@contextmanager
def _headless_viewer() -> Iterator[ViewerClient]:
    port = free_port()
    with tempfile.TemporaryFile() as output:
        options = ["--headless", "--window-size", _SIZE, "--hide-welcome-screen"]
        viewer = start_viewer(port, options, output)
        try:
            yield _connect(viewer, port, output)
        except ViewerError:
            raise
        except (RuntimeError, OSError) as lost:  # the viewer may answer before it fails
            raise ScreenshotError(_ending(viewer, output) or f"the viewer: {lost}") from None
        finally:
            stop_viewer(viewer)


def _connect(viewer: subprocess.Popen[bytes], port: int, output: IO[bytes]) -> ViewerClient:
    """A client of the viewer, as soon as the viewer answers."""
    deadline = time.monotonic() + _START_LIMIT
    while time.monotonic() < deadline:
        if viewer.poll() is not None:
            raise ScreenshotError(_reason(output))
        try:
            client = ViewerClient.connect(f"rerun+http://127.0.0.1:{port}/proxy")
            client.get_state()
            return client
        except (RuntimeError, OSError, ConnectionError):
            time.sleep(0.2)
    raise ScreenshotError(f"the viewer did not answer within {_START_LIMIT:.0f} s")


def _settled_picture(client: ViewerClient) -> bytes:
    """The picture when it no longer changes, because everything is loaded."""
    deadline = time.monotonic() + _SETTLE_LIMIT
    before, picture = b"", client.take_screenshot()
    while picture != before:
        if time.monotonic() > deadline:
            raise ScreenshotError(f"the picture keeps changing after {_SETTLE_LIMIT:.0f} s")
        time.sleep(0.3)
        before, picture = picture, client.take_screenshot()
    return picture


def _ending(viewer: subprocess.Popen[bytes], output: IO[bytes]) -> str:
    """Why the viewer has ended; empty while it runs."""
    with suppress(subprocess.TimeoutExpired):
        viewer.wait(_END_LIMIT)
        return _reason(output)
    return ""


def _reason(output: IO[bytes]) -> str:
    """Why the viewer ended, from what it printed."""
    output.seek(0)
    printed = output.read().decode(errors="replace")
    if any(word in printed for word in ("adapter", "Vulkan", "render context")):
        return (
            "no Vulkan driver is installed; a software driver is sufficient, "
            "on Debian and Ubuntu the package mesa-vulkan-drivers"
        )
    return f"the viewer exited at once: {last_line(output)}"
