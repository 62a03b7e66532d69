"""A recording as one Rerun stream: gears, curves and changes, with the layout that shows them."""

from __future__ import annotations

from pathlib import Path

import rerun as rr

from ..recording.reader import Recording
from ..recording.records import RecordingError
from ..scene import Scene, SceneError, parse_scene
from .blueprint import blueprint
from .detail import Stretch, overview, stretches
from .events import log_events
from .gears import log_gears
from .motion import motion
from .plots import log_plots
from .waveform import log_waveform

APPLICATION = "planetary_twin"


def scene_of(recording: Recording) -> tuple[Scene | None, str | None]:
    """The scene that `recording` carries; None and a remark where there is none to be read."""
    if recording.scene_yaml is None:
        return None, f"{recording.path}: carries no scene, so no gears are drawn; --scene gives one"
    try:
        return parse_scene(recording.scene_yaml), None
    except SceneError as error:
        return None, f"{recording.path}: its scene cannot be read, so no gears are drawn: {error}"


def save(
    recording: Recording,
    scene: Scene | None,
    rrd: Path,
    picture: bool = False,
    detail: Stretch | None = None,
) -> list[str]:
    """Save `recording` as Rerun file `rrd`; returns remarks on what is left out, line by line.

    `picture`: with the layout of a still picture, without the viewer's menu; `detail`: the stretch
    of simulated time [s] that is shown sample by sample, instead of where something happens.
    """
    gearset = scene.gearset if scene else None
    if scene is not None and scene.gearset.planets != recording.planets:
        raise RecordingError(
            f"scene = {scene.name}: has {scene.gearset.planets} planets, "
            f"the recording {recording.planets}"
        )
    stream = rr.RecordingStream(APPLICATION)
    try:
        stream.save(rrd)
    except RuntimeError as error:
        raise RecordingError(f"{rrd}: cannot be written: {error}") from None
    stream.send_recording_name(recording.path.stem)
    # Active, not only default: a layout that the viewer remembers from before would win otherwise.
    stream.send_blueprint(blueprint(gearset, picture), make_active=True, make_default=True)
    if gearset is not None:
        log_gears(stream, gearset, motion(recording))
    in_detail = stretches(recording) if detail is None else [detail]
    log_plots(stream, overview(recording, in_detail))
    log_events(stream, recording)
    remark = log_waveform(stream, recording, in_detail)
    stream.flush()
    stream.disconnect()
    return [remark] if remark else []
