"""`planetary-twin view` without a recording: the messages of a running twin, live.

The subscriber needs ROS; the ROS package provides it through an entry point.
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.metadata import entry_points
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from ..terminal.messages import fail

if TYPE_CHECKING:
    import rerun as rr

    from ..view.viewer import Viewer

_GROUP = "planetary_twin.live"
_NAMESPACE = "/planetary_twin"
_NICENESS = 10  # lower priority than the twin
_MEMORY = "1GB"  # of the viewer; when it is full, the oldest data are dropped

OpenStream = Callable[[], "rr.RecordingStream"]
Closed = Callable[[], bool]


def view_live(
    namespace: str | None, scene: str | None, save: Path | None, serve: bool, duration: float | None
) -> None:
    """Draw a running twin until `duration` has passed or the viewer is closed.

    Args:
        namespace: of the twin; None is /planetary_twin.
        scene: packaged scene or file to draw; None draws the scene of the twin.
        save: Rerun file to write instead of opening a window.
        serve: whether to show it in a browser.
        duration: wall time [s]; None has no limit.
    """
    from ..scene import load_scene
    from ..view.live import LiveView
    from ..view.viewer import until_interrupted

    follow = next(iter(entry_points(group=_GROUP)), None)
    if follow is None:
        fail("viewing a running twin needs the ROS package planetary_twin, which is not installed")
    chosen = None if scene is None else load_scene(scene)
    namespace = namespace or _NAMESPACE
    os.nice(_NICENESS)  # inherited by the viewer
    with until_interrupted(), _opened(save, serve) as (open_stream, closed):
        view = LiveView(namespace, open_stream, chosen)
        try:
            for records in follow.load()(namespace, duration):
                view.add(records)
                if closed():
                    return
        finally:
            if not closed():
                view.close()


def print_address(page: Viewer) -> None:
    """Print the address of a page."""
    typer.echo(f"{page.address}\nreachable from this machine only; press Ctrl-C to stop")


@contextmanager
def _opened(save: Path | None, serve: bool) -> Iterator[tuple[OpenStream, Closed]]:
    """A function that opens the stream of a run, and one that says whether the viewer is closed."""
    from ..view import viewer
    from ..view.show import to_file, to_viewer

    if save is not None:
        numbers = itertools.count(1)
        yield lambda: to_file(_numbered(save, next(numbers))), lambda: False
        return
    if not serve and not viewer.has_display():
        fail("no display for a window: use --serve or --save OUT.rrd")
    shown = (
        viewer.page("--server-memory-limit", _MEMORY)
        if serve
        else viewer.window("--memory-limit", _MEMORY, "--hide-welcome-screen")
    )
    with shown as opened:
        if serve:
            print_address(opened)
        yield lambda: to_viewer(opened.url), lambda: opened.process.poll() is not None


def _numbered(file: Path, number: int) -> Path:
    """The file of a run: `file` itself for the first run, then with a number."""
    return file if number == 1 else file.with_stem(f"{file.stem}_{number}")
