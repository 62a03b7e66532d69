"""`planetary-twin view`: shows recordings, or a running twin, in Rerun."""

from __future__ import annotations

import math
import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import complete_recording, complete_scene
from ..terminal.console import busy
from ..terminal.messages import fail, need, one_line_errors, remark
from ..terminal.output_files import file_ending_in
from ..terminal.unit_options import SECONDS, read_seconds

if TYPE_CHECKING:
    from ..recording.runs.waveform import TimeSpan
    from ..view.session import Opened, Shown
    from ..view.viewer import Viewer


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
            help="Write a Rerun file (.rrd) instead of opening a window.",
            callback=file_ending_in(".rrd"),
        ),
    ] = None,
    screenshot: Annotated[
        Path | None,
        typer.Option(
            help="Write a picture (.png) instead of opening a window; needs no display.",
            callback=file_ending_in(".png"),
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
    os.environ.setdefault("RUST_LOG", "off")  # Rerun raises its errors; do not print them twice
    need("view", "rerun", "mcap", "rosbags")
    from ..view.session import read_shown, show_live
    from ..view.viewer import ViewerError

    with one_line_errors(ViewerError):
        asked = _read_span(during)
        opened = _print_address if serve else None
        if not files:
            if screenshot is not None:
                fail("--screenshot needs a recording: name one")
            lasting = None if asked is None else asked[1] - max(asked[0], 0.0)
            show_live(namespace, scene, save, opened, lasting)
            return
        with busy(f"reading {', '.join(map(str, files))}"):
            shown = read_shown(files, namespace, scene, asked)
        for line in shown.remarks:
            remark(line)
        if save is not None:
            _write(shown, save)
            typer.echo(f"{save}: {save.stat().st_size / 1e6:.1f} MB; opens with: rerun {save}")
        if screenshot is not None:
            with busy("drawing"):
                shown.draw(screenshot, at)
            typer.echo(f"{screenshot}")
        if serve or (save is None and screenshot is None):
            _open(shown, opened)


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


def _print_address(page: Viewer) -> None:
    typer.echo(f"{page.address}\nreachable from this machine only; press Ctrl-C to stop")


def _write(shown: Shown, rrd: Path) -> None:
    with busy("drawing"):
        remarks = shown.write(rrd)
    for line in remarks:
        remark(line)


def _open(shown: Shown, opened: Opened | None) -> None:
    """Show a temporary Rerun file in a window, or in a browser."""
    from ..view.session import need_display, show

    if opened is None:
        need_display("--serve, --save OUT.rrd or --screenshot OUT.png")
    with tempfile.TemporaryDirectory() as folder:
        rrd = Path(folder) / f"{shown.recordings[0].path.stem}.rrd"
        _write(shown, rrd)
        show(rrd, opened)
