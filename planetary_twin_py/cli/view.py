"""`planetary-twin view`: look at recordings, or at a running twin, in Rerun."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ._fail import fail, remark
from ._live import look_at_twin, tell

if TYPE_CHECKING:
    from ..recording.reader import Recording
    from ..scene import Scene


def view(
    files: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="[FILE]...",
            help="Recordings, each an .mcap file or the folder of one: several lie over one "
            "another. Without: the twin that runs.",
        ),
    ] = None,
    save: Annotated[Path | None, typer.Option(help="Write a Rerun file (.rrd) instead.")] = None,
    screenshot: Annotated[
        Path | None, typer.Option(help="Write a picture (.png) instead; needs no display.")
    ] = None,
    at: Annotated[
        float | None, typer.Option(help="Time cursor of the picture: simulated time in seconds.")
    ] = None,
    serve: Annotated[
        bool, typer.Option("--serve", help="Show it in a browser instead, until Ctrl-C.")
    ] = False,
    scene: Annotated[
        str | None, typer.Option(help="Scene to draw, in place of the one in the recording.")
    ] = None,
    namespace: Annotated[
        str | None, typer.Option(help="Which gearbox, where there are several.")
    ] = None,
    duration: Annotated[
        float | None, typer.Option(help="Seconds to watch a twin that runs.", min=0.1)
    ] = None,
) -> None:
    """Open recordings, or a running twin, in Rerun: gears in 3-D, plots, one time cursor."""
    with _one_line_errors():
        if not files:
            if screenshot is not None:
                fail("screenshot: is of a recording; name one")
            look_at_twin(namespace, scene, save, serve, duration)
            return
        if duration is not None:
            fail("duration: is of a twin that runs, not of a recording")
        shown = [_read(file, namespace) for file in files]
        drawn = _scene(shown[0], scene)
        if save is not None:
            _save(shown, drawn, save)
        if screenshot is not None:
            _picture(shown, drawn, screenshot, at)
        if serve:
            _serve(shown, drawn)
        elif save is None and screenshot is None:
            _window(shown, drawn)


@contextmanager
def _one_line_errors() -> Iterator[None]:
    os.environ.setdefault("RUST_LOG", "off")  # what goes wrong is raised, too, and told once
    try:
        import rerun  # noqa: F401
    except ImportError:
        fail("the viewer is not installed: pip install 'planetary_twin_py[view]'")
    from ..recording.records import RecordingError
    from ..scene import SceneError
    from ..view.viewer import ViewerError

    try:
        yield
    except (RecordingError, SceneError, ViewerError) as error:
        fail(error)
    except OSError as error:
        fail(f"{error.filename}: {error.strerror}")


def _read(file: Path, namespace: str | None) -> Recording:
    from ..recording.reader import read_recording

    recording = read_recording(file, namespace)
    for line in recording.remarks:
        remark(line)
    return recording


def _scene(recording: Recording, chosen: str | None) -> Scene | None:
    from ..scene import load_scene
    from ..view.show import scene_of

    if chosen is not None:
        return load_scene(chosen)
    drawn, reason = scene_of(recording)
    if reason:
        remark(reason)
    return drawn


def _save(shown: Sequence[Recording], scene: Scene | None, rrd: Path) -> None:
    _write(shown, scene, rrd)
    typer.echo(f"{rrd}: {rrd.stat().st_size / 1e6:.1f} MB; opens with: rerun {rrd}")


def _picture(shown: Sequence[Recording], scene: Scene | None, png: Path, at: float | None) -> None:
    from ..recording.records import RecordingError
    from ..view.blueprint import PICTURE
    from ..view.screenshot import save_screenshot
    from ..view.show import save

    first, *others = shown
    begin, end = first.state.time[0], first.state.time[-1]
    if at is not None and not begin <= at <= end:
        raise RecordingError(f"at = {at:g}: the recording runs from {begin:g} to {end:g} s")
    with tempfile.TemporaryDirectory() as folder:
        rrd = Path(folder) / "picture.rrd"
        save(first, scene, rrd, others, PICTURE)
        save_screenshot(rrd, png, end if at is None else at)
    typer.echo(f"{png}")


def _window(shown: Sequence[Recording], scene: Scene | None) -> None:
    from ..view import viewer

    if not viewer.has_display():
        fail("no display to open a window on: use --serve, --save OUT.rrd or --screenshot OUT.png")
    with (
        _written(shown, scene) as rrd,
        viewer.until_interrupted(),
        viewer.window(str(rrd)) as window,
    ):
        if code := window.process.wait():
            fail(f"the viewer ended with exit code {code}")


def _serve(shown: Sequence[Recording], scene: Scene | None) -> None:
    from ..view import viewer

    with (
        _written(shown, scene) as rrd,
        viewer.until_interrupted(),
        viewer.page(str(rrd), "--server-memory-limit", "50%") as page,
    ):
        tell(page)
        if code := page.process.wait():
            fail(f"the viewer ended with exit code {code}")


@contextmanager
def _written(shown: Sequence[Recording], scene: Scene | None) -> Iterator[Path]:
    """A Rerun file for as long as it is looked at."""
    with tempfile.TemporaryDirectory() as folder:
        rrd = Path(folder) / f"{shown[0].path.stem}.rrd"
        _write(shown, scene, rrd)
        yield rrd


def _write(shown: Sequence[Recording], scene: Scene | None, rrd: Path) -> None:
    from ..view.show import save

    first, *others = shown
    for line in save(first, scene, rrd, others):
        remark(line)
