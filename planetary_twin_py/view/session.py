"""What `planetary-twin view` opens: recordings or a running twin, in a window, a browser or a file.

The subscriber of a running twin needs ROS; the ROS package provides it through an entry point.
"""

from __future__ import annotations

import itertools
import os
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import entry_points
from pathlib import Path

import rerun as rr

from ..recording.container.records import RecordingError
from ..recording.runs.reader import Recording, read_recording
from ..recording.runs.waveform import TimeSpan
from ..scene import Scene, load_scene
from . import viewer
from .blueprint import FILE, PICTURE, Mode
from .live import LiveView
from .screenshot import save_screenshot
from .show import save, scene_of, to_file, to_viewer
from .viewer import Viewer, ViewerError

MOST_STATES = 200_000
"""States that are shown at once: half an hour at 100 Hz, 2.2 GB of memory."""
_HALF_WIDTH = 0.5  # [s] shown on either side of the time cursor in a picture
_GROUP = "planetary_twin.live"
_NAMESPACE = "/planetary_twin"
_NICENESS = 10  # lower priority than the twin
_MEMORY = "1GB"  # of the viewer; when it is full, the oldest data are dropped

Opened = Callable[[Viewer], None]
"""Called with the page of a browser when it can be reached."""


@dataclass(frozen=True)
class Shown:
    """Contents of a view of recordings."""

    recordings: Sequence[Recording]
    scene: Scene | None
    """Of the gears, those of the first recording; None draws no gears."""
    detail: TimeSpan | None
    """Shown sample by sample [s]; None leaves the choice to the view."""
    remarks: list[str]
    """What is not shown, and why."""

    def write(self, rrd: Path, mode: Mode = FILE, detail: TimeSpan | None = None) -> list[str]:
        """Write a Rerun file, and return what it does not show.

        Args:
            rrd: file to write.
            mode: variant of the layout.
            detail: in place of that of the view [s].
        """
        first, *others = self.recordings
        return save(first, self.scene, rrd, others, mode, detail or self.detail)

    def draw(self, png: Path, at: float | None) -> None:
        """Write a picture.

        Args:
            png: file to write.
            at: time cursor [s]; None is the end of the recording.

        Raises:
            ValueError: the recording has not this time.
            ViewerError: the viewer does not start.
        """
        time = self.recordings[0].state.time
        if at is not None and not time[0] <= at <= time[-1]:
            raise RecordingError(
                f"at = {at:g}: the recording runs from {time[0]:g} to {time[-1]:g} s"
            )
        at = float(time[-1]) if at is None else at
        with tempfile.TemporaryDirectory() as folder:
            rrd = Path(folder) / "picture.rrd"
            self.write(rrd, PICTURE, self.detail or (at - _HALF_WIDTH, at + _HALF_WIDTH))
            save_screenshot(rrd, png, at)


def read_shown(
    files: Sequence[Path], namespace: str | None, scene: str | None, during: TimeSpan | None
) -> Shown:
    """Read what a view shows.

    Args:
        files: recordings; of a long one a part is read.
        namespace: of the gearbox; None if there is one.
        scene: packaged scene or file to draw; None draws the recorded one.
        during: time span to read and to show in detail [s]; None is the start.

    Raises:
        ValueError: a recording or the scene cannot be read, or `during` is not in the recording.
    """
    recordings = [_read(file, namespace, during) for file in files]
    remarks = [line for recording in recordings for line in _remarks(recording)]
    first = recordings[0]
    drawn, reason = scene_of(first) if scene is None else (load_scene(scene), None)
    remarks += [reason] if reason else []
    return Shown(recordings, drawn, _detail(first, during), remarks)


def _read(file: Path, namespace: str | None, during: TimeSpan | None) -> Recording:
    recording = read_recording(file, namespace, MOST_STATES)
    if recording.complete or during is None:
        return recording
    return read_recording(file, namespace, MOST_STATES, during)


def _remarks(recording: Recording) -> Iterator[str]:
    time = recording.state.time
    if not recording.complete:
        yield (
            f"{recording.path}: more than {MOST_STATES} states: only those from {time.min():g} to "
            f"{time.max():g} s are shown; choose others with --during BEGIN:END"
        )
    yield from recording.remarks


def _detail(recording: Recording, during: TimeSpan | None) -> TimeSpan | None:
    """The given time span clipped to the recording."""
    if during is None:
        return None
    first, last = float(recording.state.time[0]), float(recording.state.time[-1])
    begin, end = max(during[0], 0.0), min(during[1], last)
    if not begin < end:
        raise RecordingError(
            f"--during {during[0]:g}:{during[1]:g}: the recording runs from {first:g} to {last:g} s"
        )
    return begin, end


def show(rrd: Path, opened: Opened | None) -> None:
    """Show a Rerun file until the viewer is closed.

    Args:
        rrd: the file.
        opened: called with the page if it is to be shown in a browser; None opens a window.

    Raises:
        ViewerError: the viewer failed.
    """
    if opened is None:
        shown = viewer.window(str(rrd))
    else:
        shown = viewer.page(str(rrd), "--server-memory-limit", "50%")
    with viewer.until_interrupted(), shown as running:
        if opened is not None:
            opened(running)
        if code := running.process.wait():
            raise ViewerError(f"the viewer exited with code {code}")


def show_live(
    namespace: str | None,
    scene: str | None,
    save: Path | None,
    opened: Opened | None,
    duration: float | None,
) -> None:
    """Draw a running twin until `duration` has passed or the viewer is closed.

    Args:
        namespace: of the twin; None is /planetary_twin.
        scene: packaged scene or file to draw; None draws the scene of the twin.
        save: Rerun file to write instead of opening a window.
        opened: called with the page if it is to be shown in a browser.
        duration: wall time [s]; None has no limit.

    Raises:
        ViewerError: the ROS package is not installed, or there is no display.
        SceneError: the scene cannot be read.
    """
    follow = next(iter(entry_points(group=_GROUP)), None)
    if follow is None:
        raise ViewerError(
            "viewing a running twin needs the ROS package planetary_twin, which is not installed"
        )
    chosen = None if scene is None else load_scene(scene)
    namespace = namespace or _NAMESPACE
    os.nice(_NICENESS)  # inherited by the viewer
    with viewer.until_interrupted(), _live_streams(save, opened) as (open_stream, closed):
        view = LiveView(namespace, open_stream, chosen)
        try:
            for records in follow.load()(namespace, duration):
                view.add(records)
                if closed():
                    return
        finally:
            if not closed():
                view.close()


@contextmanager
def _live_streams(
    save: Path | None, opened: Opened | None
) -> Iterator[tuple[Callable[[], rr.RecordingStream], Callable[[], bool]]]:
    """A function that opens the stream of a run, and one that says whether the viewer is closed."""
    if save is not None:
        names = itertools.chain(
            [save], (save.with_stem(f"{save.stem}_{n}") for n in itertools.count(2))
        )
        yield lambda: to_file(next(names)), lambda: False
        return
    if opened is None:
        need_display("--serve or --save OUT.rrd")
        shown = viewer.window("--memory-limit", _MEMORY, "--hide-welcome-screen")
    else:
        shown = viewer.page("--server-memory-limit", _MEMORY)
    with shown as running:
        if opened is not None:
            opened(running)
        yield lambda: to_viewer(running.url), lambda: running.process.poll() is not None


def need_display(alternatives: str) -> None:
    """Raise `ViewerError` with the alternatives if there is no display for a window."""
    if not viewer.has_display():
        raise ViewerError(f"no display for a window: use {alternatives}")
