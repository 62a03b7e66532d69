"""Recordings as one Rerun stream: gears, curves, parameter changes and layout."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import rerun as rr
import rerun.blueprint as rrb

from ..recording.container.records import RecordingError
from ..recording.runs.reader import Recording
from ..recording.runs.severities import grown_before
from ..recording.runs.slow_states import read_damage, read_thermal
from ..recording.runs.waveform import TimeSpan
from ..scene import Scene, SceneError, parse_scene
from ..scene.gearset import Gearset
from .axes import Scales, log_axes, moved, scales
from .blueprint import FILE, Mode, blueprint
from .contacts import log_contacts
from .damage_page import damage_page, log_damage
from .detail import detailed_spans, overview
from .events import log_events
from .flanks import log_flanks, shown_of
from .followed import followed_of, log_followed
from .frames import frames
from .gears import log_gears, log_motion
from .layer import Layer
from .motion import Motion, motion
from .orbits import log_orbits
from .overlay import DIFFERENCE, difference, names_of
from .phase_portrait import log_phase_portrait
from .plots import log_plots, log_plots_of_axes
from .sensor_page import sensor_page
from .sensor_spectra import log_sensor_spectra
from .sensors import log_sensors, sensors_of
from .spectra import log_spectra
from .temperature_page import log_temperatures, temperature_page
from .waveform import log_waveform

APPLICATION = "planetary_twin"


def scene_of(recording: Recording) -> tuple[Scene | None, str | None]:
    """The scene in `recording`, or None and a warning if there is none or it is invalid."""
    if recording.scene_yaml is None:
        return None, f"{recording.path}: has no scene, so no gears are drawn; use --scene"
    try:
        return parse_scene(recording.scene_yaml), None
    except SceneError as error:
        return None, f"{recording.path}: its scene cannot be read, so no gears are drawn: {error}"


def save(
    recording: Recording,
    scene: Scene | None,
    rrd: Path,
    others: Sequence[Recording] = (),
    mode: Mode = FILE,
    detail: TimeSpan | None = None,
) -> list[str]:
    """Save recordings as a Rerun file.

    Args:
        recording: the first recording, of which gears and spectra are drawn.
        scene: scene of the gears; None draws no gears.
        rrd: file to write.
        others: recordings to overlay; differences of their waveforms from the first are drawn, too.
        mode: variant of the layout.
        detail: time span [s] shown sample by sample; None selects the start and the changes.

    Returns:
        Warnings about what is not shown.

    Raises:
        RecordingError: the scene does not match, or the file cannot be written.
    """
    check_scene(scene, recording)
    names = names_of([recording, *others])
    stream = to_file(rrd)
    stream.send_recording_name(", ".join(name for name in names if name) or recording.path.stem)
    compared = names[0] if others else None
    drawn = None if scene is None else scales(scene.gearset, recording.axes_state)
    followed = followed_of(recording)
    place = recording.path, recording.namespace, recording.topics
    damage, thermal = read_damage(*place), read_thermal(*place)
    sensors = sensors_of(recording)
    send_layout(
        stream, scene, mode, compared, drawn,
        followed=followed is not None,
        pages=[
            *([] if damage is None else [damage_page(damage.names)]),
            *([] if thermal is None else [temperature_page(thermal)]),
            *(sensor_page(sensor.page) for sensor in sensors),
        ],
    )  # fmt: skip
    layers = [Layer(stream, name, order) for order, name in enumerate(names)]
    in_detail = detailed_spans(recording) if detail is None else [detail]
    remarks = []
    for layer, shown in zip(layers, (recording, *others), strict=True):
        remarks += log_curves(layer, shown, in_detail)
        remarks += log_sensors(layer, shown, in_detail)
    for sensor in sensors:
        every = recording, *others
        remarks += log_sensor_spectra(layers, every, sensor, scene, in_detail)
    if followed is not None:
        log_followed(layers[0], recording, followed)
    if damage is not None:
        log_damage(layers[0], damage)
    if thermal is not None:
        log_temperatures(layers[0], thermal)
    sampled = recording.within(in_detail)
    remarks += _log_first(layers[0], sampled, scene, drawn)
    for layer, other in zip(layers[1:], others, strict=True):
        remarks += _log_difference(layer, sampled, other.within(in_detail), in_detail)
    stream.flush()
    stream.disconnect()
    return remarks


def to_file(rrd: Path) -> rr.RecordingStream:
    """A stream into a Rerun file."""
    stream = rr.RecordingStream(APPLICATION)
    try:
        stream.save(rrd)
    except RuntimeError as error:
        raise RecordingError(f"{rrd}: is not writable: {error}") from None
    return stream


def to_viewer(url: str) -> rr.RecordingStream:
    """A stream to the running viewer at `url`."""
    stream = rr.RecordingStream(APPLICATION)
    stream.connect_grpc(url)
    return stream


def check_scene(scene: Scene | None, recording: Recording) -> None:
    """Raise `RecordingError` if the numbers of planets of `scene` and `recording` differ."""
    if scene is not None and scene.gearset.planets != recording.planets:
        raise RecordingError(
            f"scene = {scene.name}: has {scene.gearset.planets} planets, "
            f"but the recording has {recording.planets}"
        )


def send_layout(
    stream: rr.RecordingStream,
    scene: Scene | None,
    mode: Mode,
    compared: str | None = None,
    axes: Scales | None = None,
    *,
    followed: bool = False,
    pages: Sequence[rrb.Container | rrb.View] = (),
) -> None:
    """Send the layout; see `blueprint` for the arguments after `scene`.

    Args:
        stream: Rerun stream.
        scene: scene of the gears; None shows no gears.
        mode: see `blueprint`.
        compared: see `blueprint`.
        axes: see `blueprint`.
        followed: see `blueprint`.
        pages: see `blueprint`.
    """
    gearset = scene.gearset if scene else None
    layout = blueprint(
        gearset, mode, compared, axes,
        followed=followed, flanks=() if scene is None else shown_of(scene), pages=pages,
    )  # fmt: skip
    # Active, because the viewer would otherwise prefer a layout stored earlier.
    stream.send_blueprint(layout, make_active=True, make_default=True)


def log_curves(layer: Layer, recording: Recording, detail: list[TimeSpan]) -> list[str]:
    """Log curves and changes, with samples in `detail`; return warnings.

    Args:
        layer: recording to draw into.
        recording: recording to draw.
        detail: time spans [s] shown sample by sample.
    """
    shown = overview(recording, detail)
    log_plots(layer, shown)
    log_plots_of_axes(layer, shown)
    log_events(layer, recording)
    remark = log_waveform(layer, recording, detail)
    return [remark] if remark else []


def _log_first(
    layer: Layer, recording: Recording, scene: Scene | None, drawn: Scales | None
) -> list[str]:
    """Log the parts of the first recording only: gears, contacts, spectra; return warnings."""
    grown = None
    if scene is not None:
        turned = motion(recording)
        log_gears(layer, scene.gearset)
        log_solids(layer, recording, scene.gearset, turned, drawn)
        log_contacts(layer, scene, recording, turned)
        grown = grown_before(scene, recording.operating_point, turned.time)
    windows = frames(recording)
    if windows is None:
        return [grown] if grown else []
    aliases = log_spectra(layer, windows, scene)
    log_phase_portrait(layer, windows, scene)
    if scene is not None:
        log_flanks(layer, windows, scene, turned)
    samples = recording.axes_blocks.samples(-math.inf, math.inf) if drawn else None
    if samples is not None:
        log_orbits(layer, windows, samples)
    return [remark for remark in (grown, windows.remark, aliases) if remark is not None]


def log_solids(
    layer: Layer, recording: Recording, gearset: Gearset, turned: Motion, drawn: Scales | None
) -> None:
    """Log the motion of the gears, and bearing forces and displacements if axes move.

    Args:
        layer: recording to draw into.
        recording: recording to draw.
        gearset: the gears.
        turned: angles of the members over time.
        drawn: how moving axes are drawn; None if axes are held.
    """
    if drawn is None or not recording.moves_axes:
        log_motion(layer, gearset, turned)
        return
    log_motion(layer, gearset, turned, moved(recording.axes_state, turned, gearset, drawn))
    log_axes(layer, recording, gearset, turned, drawn)


def _log_difference(
    layer: Layer, first: Recording, other: Recording, detail: list[TimeSpan]
) -> list[str]:
    try:
        differences = difference(first, other)
    except RecordingError as reason:
        return [str(reason)]
    # Its warning about omitted samples repeats that of the recording.
    log_waveform(replace(layer, below=DIFFERENCE, order=layer.order - 1), differences, detail)
    return []
