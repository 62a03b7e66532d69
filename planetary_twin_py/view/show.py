"""A recording as one Rerun stream: gears, curves and changes, with the layout that shows them."""

from __future__ import annotations

import rerun as rr

from ..recording.reader import Recording
from ..scene import Scene, SceneError, parse_scene
from .blueprint import blueprint
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


def open_stream(recording: Recording) -> rr.RecordingStream:
    """A new Rerun stream for `recording`, not yet connected to a file or viewer."""
    return rr.RecordingStream(APPLICATION, recording_id=None, send_properties=True)


def log_recording(
    stream: rr.RecordingStream, recording: Recording, scene: Scene | None
) -> list[str]:
    """Log everything `recording` holds and its layout to `stream`; returns remarks, line by line."""
    gearset = scene.gearset if scene else None
    if gearset is not None and gearset.planets != recording.planets:
        raise ValueError(
            f"scene = {scene.name}: has {gearset.planets} planets, the recording {recording.planets}"
        )
    stream.send_recording_name(recording.path.stem)
    stream.send_blueprint(blueprint(gearset), make_active=True, make_default=True)
    if gearset is not None:
        log_gears(stream, gearset, motion(recording))
    log_plots(stream, recording)
    log_events(stream, recording)
    remark = log_waveform(stream, recording)
    stream.flush()
    return [remark] if remark else []
