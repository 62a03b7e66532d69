"""Strips of flanks: pairs of teeth side by side, coloured along their path of contact.

A strip is a tooth pair from the start of its path of contact to the end, at the loads with which it
passed: Hertz pressure, contact temperature, and wear if the scene has its law.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import rerun as rr
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from numpy.typing import NDArray

from ..gearset.geometry import PathOfContact
from ..model.gearbox import Gearbox
from ..model.pair_loads import pair_loads
from ..recording.runs.slow_states import SlowStates, read_thermal
from ..scene import OperatingPoint, Scene
from . import timeline
from .chart import SHADES, Chart, dark
from .flank_state import FlankState, flank_state
from .frames import Frames
from .layer import Layer
from .motion import Motion

Array = NDArray[np.float64]

SIZE = (560, 250)
GEARS = ("sun", "planet", "ring")
STRIPS, CELLS = 8, 24  # pairs of a mesh that are shown, and parts of a strip
APART = 2.0  # distance of the strips of both meshes, in strips
MOST_FRAMES = 60
_FILLED = 0.9  # of the width of a strip


class Shown(NamedTuple):
    """A quantity of the strips."""

    field: str
    title: str
    factor: float
    offset: float = 0.0


SHOWN = (
    Shown("pressure", "Hertz pressure of tooth pairs [MPa]", 1e-6),
    Shown("temperature", "Contact temperature (Blok) [°C]", 1.0, -273.15),
    Shown("wear", "Wear of a passage, both flanks [nm]", 1e9),
)


def shown_of(scene: Scene) -> tuple[Shown, ...]:
    """The quantities of a scene: none of helical teeth, no wear without its law."""
    if scene.gearset.helix_angle != 0.0:
        return ()
    wears = scene.durability is not None and scene.durability.wear is not None
    return SHOWN if wears else SHOWN[:2]


def log_flanks(layer: Layer, frames: Frames, scene: Scene, motion: Motion) -> None:
    """Log the strips of planet 1, below /flanks, for times along the recording.

    Args:
        layer: recording to draw into.
        frames: times, and the waveform.
        scene: gears, oil, and the law of wear.
        motion: angles of the members.
    """
    shown = shown_of(scene)
    chosen = np.unique(np.linspace(0, len(frames.time) - 1, MOST_FRAMES).astype(int))
    warm = _temperatures(frames)
    states = [_strips(frames, scene, motion, int(n), warm) for n in chosen] if shown else []
    for each in shown:
        values = np.array([[getattr(s, each.field) for s in both] for both in states])
        values = each.factor * values + each.offset
        if np.isfinite(values).any():
            _draw(layer, each, values, frames, chosen, scene)


def _strips(
    frames: Frames, scene: Scene, motion: Motion, number: int, warm: SlowStates | None
) -> list[FlankState]:
    """State of the strips of the sun and the ring mesh of planet 1, (STRIPS x CELLS,) each."""
    point, found = _point(frames, scene, number), []
    for kind in (0, 1):
        if warm is not None:  # film and friction follow the mean temperature of both gears
            gears = [warm.names.index(gear) for gear in GEARS[kind : kind + 2]]
            mean = np.interp(frames.time[number], warm.time, warm.values[:, gears].mean(axis=1))
            point = point.model_copy(update={"oil_temperature": float(mean)})
        found.append(_mesh(frames, scene, motion, kind, number, point))
    return found


def _temperatures(frames: Frames) -> SlowStates | None:
    """Temperatures of the recording, if they are states."""
    recording = frames.recording
    thermal = read_thermal(recording.path, recording.namespace, recording.topics)
    return None if thermal is None else thermal.temperatures


def _point(frames: Frames, scene: Scene, number: int) -> OperatingPoint:
    series = frames.recording.operating_point
    row = int(np.searchsorted(series.time, frames.time[number], side="right")) - 1
    names = ("oil_temperature", "lambda_ratio")
    known = {name: float(series[name][row]) for name in names if row >= 0}
    return scene.operating_point.model_copy(update=known)


def _mesh(
    frames: Frames, scene: Scene, motion: Motion, kind: int, number: int, point: OperatingPoint
) -> FlankState:
    """The last pairs that have passed the mesh of planet 1 until a time."""
    wave, mesh = frames.recording.waveform, kind * scene.gearset.planets
    now, speed = frames.time[number], abs(float(frames.state("mesh_frequency")[number]))
    assert wave is not None
    path = scene.gearset.geometry.meshes[kind].path
    position = -path.approach + path.contact_ratio * (np.arange(CELLS) + 0.5) / CELLS
    everywhere, load = np.tile(position, STRIPS), np.zeros(STRIPS * CELLS)
    if speed > 0.0:
        since = now - (STRIPS + path.contact_ratio + 1.0) / speed
        rows = slice(*(int(end) for end in np.searchsorted(wave.time, (since, now))))
        samples = wave.time[rows], wave.mesh_force[rows, mesh].astype(np.float64)
        load = _loads(Gearbox(scene), mesh, motion, samples, position)
    return flank_state(scene, kind, point, speed, everywhere, load)


def _loads(
    gearbox: Gearbox, mesh: int, motion: Motion, samples: tuple[Array, Array], position: Array
) -> Array:
    """Loads [N] of the last `STRIPS` pairs at positions, (STRIPS x positions,), 0 if unknown.

    `samples` are times [s] and forces [N] of the mesh.
    """
    time, force = samples
    unknown = np.zeros(STRIPS * len(position))
    if len(time) < 2 or not np.all(force * force[0] > 0.0):
        return unknown  # flanks part, or change sides
    pairs = pair_loads(gearbox, mesh, _angles(motion, time), force)
    cycle = np.unwrap(pairs.position[:, 0], period=1.0)
    back = np.arange(STRIPS)[::-1, None]
    if cycle[-1] > cycle[0]:
        passed = np.floor(cycle[-1] - position[-1]) - back + position
    else:  # a pair enters where its recess ends
        passed = np.ceil(cycle[-1] - position[0]) + back + position
    order = np.argsort(cycle)
    ends = {"left": np.nan, "right": np.nan}
    when = np.interp(passed.ravel(), cycle[order], time[order], **ends)
    known = np.isfinite(when)
    at = np.where(known, when, time[0])
    found = pair_loads(gearbox, mesh, _angles(motion, at), np.interp(at, time, force))
    away = np.abs(found.position - np.tile(position, STRIPS)[:, None])
    load = found.load[np.arange(len(at)), np.argmin(away, axis=1)]
    return np.where(known, load, unknown)


def _angles(motion: Motion, time: Array) -> Mapping[str, Array]:
    return {name: np.interp(time, motion.time, each) for name, each in motion.angle.items()}


def _draw(
    layer: Layer, shown: Shown, values: Array, frames: Frames, chosen: NDArray[np.intp],
    scene: Scene,
) -> None:  # fmt: skip
    """Draw (times, 2, STRIPS x CELLS) values."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    paths = [mesh.path for mesh in scene.gearset.geometry.meshes]
    begin, end = -max(p.approach for p in paths), max(p.recess for p in paths)
    width = 2.0 * STRIPS + APART
    middles = [0.5 * STRIPS, 1.5 * STRIPS + APART]
    chart = Chart(
        f"flanks/{shown.field}", SIZE, xlim=(0.0, width), ylim=(begin, end), xticks=middles,
        xticklabels=["sun_planet_1", "planet_ring_1"], ylabel="base pitches after the pitch point",
    )  # fmt: skip
    with dark():
        scale = ScalarMappable(Normalize(low, high if high > low else low + 1.0), SHADES)
        chart.figure.colorbar(scale, ax=chart.axes)
    chart.log(layer)
    cells = np.concatenate([_cells(chart, kind, paths[kind]) for kind in (0, 1)])
    edges = chart.place([0.0, _FILLED], [0.0, 0.0])
    present = np.isfinite(values).reshape(len(values), -1)
    colours = colormaps[SHADES](scale.norm(values.reshape(present.shape)[present]), bytes=True)
    columns = rr.LineStrips2D.columns(
        strips=np.concatenate([cells[there] for there in present]),
        colors=colours,
        radii=np.full(len(colours), 0.5 * float(edges[1, 0] - edges[0, 0])),
    ).partition(present.sum(axis=1))
    index = timeline.columns(frames.time[chosen], frames.stamp[chosen])
    layer.send_columns(f"flanks/{shown.field}/strips", index, columns)


def _cells(chart: Chart, kind: int, path: PathOfContact) -> NDArray[np.float32]:
    """Lines of the cells of the strips of a mesh on a chart, (STRIPS x CELLS, 2, 2)."""
    edges = np.linspace(-path.approach, path.recess, CELLS + 1)
    first = kind * (STRIPS + APART) + 0.5
    columns = [chart.place(np.full(CELLS + 1, first + n), edges) for n in range(STRIPS)]
    return np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in columns])
