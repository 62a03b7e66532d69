"""`planetary-twin view`: look at a recording in Rerun."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ._fail import fail, remark

if TYPE_CHECKING:
    from ..recording.reader import Recording
    from ..scene import Scene
    from ..view.detail import Stretch


_SEEN = 0.5  # [s] on either side of the time cursor, in a picture that cannot be zoomed


def view(
    file: Annotated[Path, typer.Argument(help="Recording: an .mcap file or the folder of one.")],
    save: Annotated[Path | None, typer.Option(help="Write a Rerun file (.rrd) instead.")] = None,
    screenshot: Annotated[
        Path | None, typer.Option(help="Write a picture (.png) instead; needs no display.")
    ] = None,
    at: Annotated[
        float | None, typer.Option(help="Time cursor of the picture: simulated time in seconds.")
    ] = None,
    scene: Annotated[
        str | None, typer.Option(help="Scene to draw, in place of the one in the recording.")
    ] = None,
    namespace: Annotated[
        str | None, typer.Option(help="Which gearbox, if the recording holds several.")
    ] = None,
    from_: Annotated[
        float | None,
        typer.Option("--from", help="Show every sample from this simulated time [s] on."),
    ] = None,
    to: Annotated[
        float | None, typer.Option(help="Show every sample up to this simulated time [s].")
    ] = None,
) -> None:
    """Open a recording in Rerun: gears in 3-D, plots, one time cursor."""
    try:
        import rerun  # noqa: F401
    except ImportError:
        fail("the viewer is not installed: pip install 'planetary_twin_py[view]'")
    from ..recording.records import RecordingError
    from ..scene import SceneError
    from ..view.screenshot import ScreenshotError

    try:
        recording, drawn = _load(file, namespace, scene)
        detail = _detail(recording, from_, to)
        if save is not None:
            _save(recording, drawn, save, detail)
        if screenshot is not None:
            _picture(recording, drawn, screenshot, at, detail)
        if save is None and screenshot is None:
            _window(recording, drawn, detail)
    except (RecordingError, SceneError, ScreenshotError) as error:
        fail(error)
    except OSError as error:
        fail(f"{error.filename}: {error.strerror}")


def _load(file: Path, namespace: str | None, scene: str | None) -> tuple[Recording, Scene | None]:
    from ..recording.reader import read_recording
    from ..scene import load_scene
    from ..view.show import scene_of

    recording = read_recording(file, namespace)
    for line in recording.remarks:
        remark(line)
    if scene is not None:
        return recording, load_scene(scene)
    drawn, reason = scene_of(recording)
    if reason:
        remark(reason)
    return recording, drawn


def _detail(recording: Recording, begin: float | None, end: float | None) -> Stretch | None:
    """The stretch that is asked for, None where it is left to the viewer."""
    from ..recording.records import RecordingError

    if begin is None and end is None:
        return None
    first, last = float(recording.state.time[0]), float(recording.state.time[-1])
    stretch = first if begin is None else begin, last if end is None else end
    if not (stretch[0] < stretch[1] and stretch[0] < last and stretch[1] > 0.0):
        raise RecordingError(
            f"--from {stretch[0]:g} --to {stretch[1]:g}: must be a stretch within "
            f"{first:g} to {last:g} s"
        )
    return stretch


def _save(recording: Recording, scene: Scene | None, rrd: Path, detail: Stretch | None) -> None:
    from ..view import show

    for line in show.save(recording, scene, rrd, detail=detail):
        remark(line)
    typer.echo(f"{rrd}: {rrd.stat().st_size / 1e6:.1f} MB; opens with: rerun {rrd}")


def _picture(
    recording: Recording,
    scene: Scene | None,
    png: Path,
    at: float | None,
    detail: Stretch | None,
) -> None:
    from ..recording.records import RecordingError
    from ..view import show
    from ..view.screenshot import save_screenshot

    first, last = recording.state.time[0], recording.state.time[-1]
    if at is not None and not first <= at <= last:
        raise RecordingError(f"at = {at:g}: the recording runs from {first:g} to {last:g} s")
    at = last if at is None else at
    with tempfile.TemporaryDirectory() as folder:
        rrd = Path(folder) / "picture.rrd"
        show.save(recording, scene, rrd, picture=True, detail=detail or (at - _SEEN, at + _SEEN))
        save_screenshot(rrd, png, at)
    typer.echo(f"{png}")


def _window(recording: Recording, scene: Scene | None, detail: Stretch | None) -> None:
    from ..view import show, viewer

    if not viewer.has_display():
        fail("no display to open a window on: use --save OUT.rrd or --screenshot OUT.png")
    with tempfile.TemporaryDirectory() as folder:
        rrd = Path(folder) / f"{recording.path.stem}.rrd"
        for line in show.save(recording, scene, rrd, detail=detail):
            remark(line)
        if code := viewer.show(rrd):
            fail(f"the viewer ended with exit code {code}")
