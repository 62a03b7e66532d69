"""`planetary-twin view`: shows recordings, or a running twin, in Rerun."""

from __future__ import annotations

import math
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from ..terminal.arguments import complete_recording, complete_scene
from ..terminal.console import busy
from ..terminal.messages import fail, need, remark
from ..terminal.output_files import output_file
from ..terminal.unit_options import SECONDS, read_seconds
from ._live import print_address, view_live

if TYPE_CHECKING:
    from ..recording.runs.reader import Recording
    from ..recording.runs.waveform import TimeSpan
    from ..scene import Scene


MOST_STATES = 200_000
"""States that are shown at once: half an hour at 100 Hz, 2.2 GB of memory."""
_HALF_WIDTH = 0.5  # [s] shown on either side of the time cursor in a picture


def view(
    files: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="FILE",
            autocompletion=complete_recording,
            help="Recordings, each an .mcap file or its folder; several are overlaid.",
            show_default="the running twin",
        ),
    ] = None,
    save: Annotated[
        Path | None,
        typer.Option(
            help="Write a Rerun file (.rrd) instead of opening a window.", callback=output_file
        ),
    ] = None,
    screenshot: Annotated[
        Path | None,
        typer.Option(
            help="Write a picture (.png) instead of opening a window; needs no display.",
            callback=output_file,
        ),
    ] = None,
    at: Annotated[
        float | None,
        typer.Option(
            help="Time cursor of the picture in simulated time.",
            show_default="end of the recording",
            **SECONDS,
        ),
    ] = None,
    serve: Annotated[
        bool, typer.Option("--serve", help="Show it in a browser, until Ctrl-C.")
    ] = False,
    scene: Annotated[
        str | None,
        typer.Option(
            help="Scene to draw, in place of the recorded one.",
            autocompletion=complete_scene,
        ),
    ] = None,
    namespace: Annotated[
        str | None, typer.Option(help="Namespace of the gearbox, if there are several.")
    ] = None,
    during: Annotated[
        str | None,
        typer.Option(
            metavar="BEGIN:END",
            help="Show every sample of this interval of simulated time [s]; with a running twin, "
            "the length of the interval is the time to watch.",
        ),
    ] = None,
) -> None:
    """Open recordings, or a running twin, in Rerun: gears in 3-D, plots, one time cursor.

    Example: planetary-twin view recordings/NAME --during 2:3
    """
    for option, path, suffix in (("--save", save, ".rrd"), ("--screenshot", screenshot, ".png")):
        if path is not None and path.suffix != suffix:
            fail(f"{option} = {str(path)!r}: must end in {suffix}")
    with _one_line_errors():
        asked = _read_span(during)
        if not files:
            if screenshot is not None:
                fail("--screenshot needs a recording: name one")
            lasting = None if asked is None else asked[1] - max(asked[0], 0.0)
            view_live(namespace, scene, save, serve, lasting)
            return
        recordings = [_read(file, namespace, asked) for file in files]
        shown = _Shown(recordings, _scene(recordings[0], scene), _detail(recordings[0], asked))
        if save is not None:
            _save(shown, save)
        if screenshot is not None:
            _picture(shown, screenshot, at)
        if serve:
            _serve(shown)
        elif save is None and screenshot is None:
            _window(shown)


class _Shown(NamedTuple):
    """Contents of a view: recordings, scene of the first one, time span shown in detail."""

    recordings: list[Recording]
    scene: Scene | None
    detail: TimeSpan | None


@contextmanager
def _one_line_errors() -> Iterator[None]:
    os.environ.setdefault("RUST_LOG", "off")  # Rerun raises its errors; do not print them twice
    need("view", "rerun", "mcap", "rosbags")
    from ..recording.container.records import RecordingError
    from ..scene import SceneError
    from ..view.viewer import ViewerError

    try:
        yield
    except (RecordingError, SceneError, ViewerError, OSError) as error:
        fail(error)


def _read(file: Path, namespace: str | None, asked: TimeSpan | None) -> Recording:
    """A recording; of a long one the part that `asked` or, without it, the first one."""
    from ..recording.runs.reader import read_recording

    with busy(f"reading {file}"):
        recording = read_recording(file, namespace, MOST_STATES)
        if not recording.complete and asked is not None:
            recording = read_recording(file, namespace, MOST_STATES, asked)
    if not recording.complete:
        remark(
            f"{file}: more than {MOST_STATES} states: only those from "
            f"{recording.state.time.min():g} to {recording.state.time.max():g} s are shown; "
            "choose others with --during BEGIN:END"
        )
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


def _read_span(text: str | None) -> TimeSpan | None:
    """Start and end [s] of BEGIN:END; an omitted one is infinite."""
    if text is None:
        return None
    begin, colon, end = text.partition(":")
    try:
        found = read_seconds(begin or -math.inf), read_seconds(end or math.inf)
    except typer.BadParameter:
        found = math.nan, math.nan
    if not (colon and found[0] < found[1]):
        fail(f"--during {text!r}: must be BEGIN:END in seconds, e.g. 2.5:3 or 10: or :5")
    return found


def _detail(recording: Recording, asked: TimeSpan | None) -> TimeSpan | None:
    """The given time span clipped to the recording; None leaves the choice to the view."""
    from ..recording.container.records import RecordingError

    if asked is None:
        return None
    first, last = float(recording.state.time[0]), float(recording.state.time[-1])
    begin, end = max(asked[0], 0.0), min(asked[1], last)
    if not begin < end:
        raise RecordingError(
            f"--during {asked[0]:g}:{asked[1]:g}: the recording runs from {first:g} to {last:g} s"
        )
    return begin, end


def _save(shown: _Shown, rrd: Path) -> None:
    _write(shown, rrd)
    typer.echo(f"{rrd}: {rrd.stat().st_size / 1e6:.1f} MB; opens with: rerun {rrd}")


def _picture(shown: _Shown, png: Path, at: float | None) -> None:
    from ..recording.container.records import RecordingError
    from ..view.blueprint import PICTURE
    from ..view.screenshot import save_screenshot
    from ..view.show import save

    first, *others = shown.recordings
    begin, end = first.state.time[0], first.state.time[-1]
    if at is not None and not begin <= at <= end:
        raise RecordingError(f"at = {at:g}: the recording runs from {begin:g} to {end:g} s")
    at = end if at is None else at
    detail = shown.detail or (at - _HALF_WIDTH, at + _HALF_WIDTH)
    with tempfile.TemporaryDirectory() as folder:
        rrd = Path(folder) / "picture.rrd"
        with busy("drawing"):
            save(first, shown.scene, rrd, others, PICTURE, detail)
            save_screenshot(rrd, png, at)
    typer.echo(f"{png}")


def _window(shown: _Shown) -> None:
    from ..view import viewer

    if not viewer.has_display():
        fail("no display for a window: use --serve, --save OUT.rrd or --screenshot OUT.png")
    with (
        _written(shown) as rrd,
        viewer.until_interrupted(),
        viewer.window(str(rrd)) as window,
    ):
        if code := window.process.wait():
            fail(f"the viewer exited with code {code}")


def _serve(shown: _Shown) -> None:
    from ..view import viewer

    with (
        _written(shown) as rrd,
        viewer.until_interrupted(),
        viewer.page(str(rrd), "--server-memory-limit", "50%") as page,
    ):
        print_address(page)
        if code := page.process.wait():
            fail(f"the viewer exited with code {code}")


@contextmanager
def _written(shown: _Shown) -> Iterator[Path]:
    """A temporary Rerun file."""
    with tempfile.TemporaryDirectory() as folder:
        rrd = Path(folder) / f"{shown.recordings[0].path.stem}.rrd"
        _write(shown, rrd)
        yield rrd


def _write(shown: _Shown, rrd: Path) -> None:
    from ..view.show import save

    first, *others = shown.recordings
    with busy("drawing"):
        remarks = save(first, shown.scene, rrd, others, detail=shown.detail)
    for line in remarks:
        remark(line)
