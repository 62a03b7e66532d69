"""`planetary-twin view` without a recording: what a running twin publishes, as it comes.

What hears the twin needs ROS: it comes with the ROS package, through an entry point.
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

from ._fail import fail

if TYPE_CHECKING:
    import rerun as rr

    from ..view.viewer import Viewer

_GROUP = "planetary_twin.live"
_NAMESPACE = "/planetary_twin"
_YIELDING = 10  # niceness: where the processor is short, the twin goes first
_MEMORY = "1GB"  # of what is shown; where it is full, the oldest goes

Begin = Callable[[], "rr.RecordingStream"]
Closed = Callable[[], bool]


def look_at_twin(
    namespace: str | None, scene: str | None, save: Path | None, serve: bool, duration: float | None
) -> None:
    """Draw the twin in `namespace` for `duration` [s], or until it is no longer looked at."""
    from ..scene import load_scene
    from ..view.live import LiveView
    from ..view.viewer import until_interrupted

    follow = next(iter(entry_points(group=_GROUP)), None)
    if follow is None:
        fail("a running twin is heard by the nodes' package, which is not installed")
    chosen = None if scene is None else load_scene(scene)
    namespace = namespace or _NAMESPACE
    os.nice(_YIELDING)  # also what is started here
    with until_interrupted(), _looked_at(save, serve) as (begin, closed):
        view = LiveView(namespace, begin, chosen)
        try:
            for records in follow.load()(namespace, duration):
                view.take(records)
                if closed():
                    return
        finally:
            if not closed():
                view.close()


def tell(page: Viewer) -> None:
    """Say where a page is."""
    typer.echo(f"{page.address}\non this machine only; Ctrl-C ends it")


@contextmanager
def _looked_at(save: Path | None, serve: bool) -> Iterator[tuple[Begin, Closed]]:
    """What opens the stream of a run, and whether nobody looks any longer."""
    from ..view import viewer
    from ..view.show import to_file, to_viewer

    if save is not None:
        numbers = itertools.count(1)
        yield lambda: to_file(_numbered(save, next(numbers))), lambda: False
        return
    if not serve and not viewer.has_display():
        fail("no display to open a window on: use --serve or --save OUT.rrd")
    shown = (
        viewer.page("--server-memory-limit", _MEMORY)
        if serve
        else viewer.window("--memory-limit", _MEMORY, "--hide-welcome-screen")
    )
    with shown as there:
        if serve:
            tell(there)
        yield lambda: to_viewer(there.url), lambda: there.process.poll() is not None


def _numbered(file: Path, number: int) -> Path:
    """The file of a run: of the first as it is called."""
    return file if number == 1 else file.with_stem(f"{file.stem}_{number}")
