"""Tooth pairs in contact: the line where two flanks touch, across the face width of spur teeth,
across a part of it and inclined of helical teeth.

The line is brighter and thicker for a larger load. From its end it goes on to the front of the
gears and is bent there in the direction of the force of the first gear on the second, in proportion
to the load. The loaded flank (drive or coast) is drawn; an open mesh has no line.
/gears/carrier/contact/MESH moves with the carrier, in which the line of action is fixed.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import rerun as rr
from matplotlib import colormaps
from numpy.typing import NDArray

from .._core import Train
from ..gearset.line_of_action import COAST, DRIVE, line_of_action
from ..model.gearbox import Gearbox
from ..model.pair_loads import pair_loads, train_with
from ..recording.runs.reader import Recording
from ..recording.runs.severities import Recorded, stretches
from ..scene import Scene
from ..scene.gearset import Gearset
from ..units.engineering import figure
from . import timeline
from .chart import SHADES
from .gears import MILLIMETRES
from .layer import Layer
from .motion import Motion
from .round_numbers import round_up

Array = NDArray[np.float64]
_FULL = 0.99  # quantile of the loads at the end of the scale; rare impacts exceed it
_OVERHANG = 0.06  # of the face width, so that the end is visible in front of the gears
_THICKEST, _LONGEST = 0.24, 3.0  # radius and bend at the full load [modules]
_BARS = 48  # steps of the drawn scale
_BLOCK = 8192  # times that are sent at once: about 30 MB while they become strips
_NEAR = 2e-4  # [s], largest time difference between a sample and its use


@dataclass(frozen=True)
class Contacts:
    """Tooth pairs of one mesh at n times, at most p pairs each, in the carrier."""

    ends: Array
    """Both ends of the line of contact [m], that with the lower z first, (n, p, 2, 3)."""
    direction: Array
    """Unit vector of the force on the second gear, (n, p, 2)."""
    load: Array
    """[N], 0 without contact, (n, p)."""

    @property
    def point(self) -> Array:
        """Middle of the line of contact, x and y [m], (n, p, 2)."""
        return np.asarray(self.ends[..., :2].mean(axis=2))


def log_contacts(layer: Layer, scene: Scene, recording: Recording, motion: Motion) -> None:
    """Log the tooth pairs in contact at the times of `motion`, and the scale of their loads.

    Args:
        layer: recording to draw into.
        scene: gears, stiffness and faults.
        recording: recording to draw.
        motion: angles at the times to draw.
    """
    gearbox, meshes, force = Gearbox(scene), recording.meshes, forces(recording, motion.time)
    drawn = Recorded(motion.time, motion.stamp, motion.angle, force)
    blocks = [*_blocks(gearbox, recording, drawn)]

    def angles(rows: slice) -> dict[str, Array]:
        return {member: angle[rows] for member, angle in motion.angle.items()}

    loads = []
    for rows, train in blocks:
        for mesh in range(len(meshes)):
            load = pair_loads(gearbox, mesh, angles(rows), force[rows, mesh], train).load
            loads.append(load[load > 0.0])
    loaded = np.concatenate(loads)
    if not len(loaded):
        return
    full = round_up(float(np.quantile(loaded, _FULL)))
    for rows, train in blocks:
        index = timeline.columns(motion.time[rows], motion.stamp[rows])
        for mesh, name in enumerate(meshes):
            found = contacts(gearbox, mesh, angles(rows), force[rows, mesh], train)
            columns = _strips(scene.gearset, found, full)
            layer.send_columns(f"gears/carrier/contact/{name}", index, columns)
    _log_scale(layer, scene.gearset, full)


def _blocks(
    gearbox: Gearbox, recording: Recording, drawn: Recorded
) -> Iterator[tuple[slice, Train]]:
    """Rows that are sent at once, and the train with their severities."""
    for begin, end, severities in stretches(gearbox, recording.operating_point, drawn):
        train = train_with(gearbox, severities)
        for first in range(begin, end, _BLOCK):
            yield slice(first, min(first + _BLOCK, end)), train


def forces(recording: Recording, time: Array) -> Array:
    """Forces of the meshes [N] at `time` [s] (n,), shape (n, meshes).

    They are samples of the waveform, or means of the interval where there is no sample.

    Args:
        recording: has waveform or states.
        time: [s], (n,).
    """
    state = recording.state
    row = np.minimum(np.searchsorted(state.time, time), len(state) - 1)
    force = np.nan_to_num(recording.per_mesh("mesh_force_mean"))[row]
    wave = recording.waveform
    if wave is None or len(wave.time) < 2:
        return force
    after = np.clip(np.searchsorted(wave.time, time), 1, len(wave.time) - 1)
    nearest = np.where(time - wave.time[after - 1] < wave.time[after] - time, after - 1, after)
    has_sample = np.abs(wave.time[nearest] - time) < _NEAR
    force[has_sample] = wave.mesh_force[nearest[has_sample]]
    return force


def contacts(
    gearbox: Gearbox,
    mesh: int,
    angle: Mapping[str, Array],
    force: Array,
    train: Train | None = None,
) -> Contacts:
    """Tooth pairs that carry the force of a mesh, by the stiffness and the faults of the model.

    Args:
        gearbox: gears, stiffness and faults.
        mesh: index of the mesh in a recording.
        angle: angles of the members [rad] (n,), see `pair_loads`.
        force: force of the mesh [N] (n,), negative on the coast flanks.
        train: with the present severities, see `pair_loads`.

    Returns:
        Lines of contact, directions and loads.
    """
    gearset = gearbox.scene.gearset
    ring, planet = divmod(mesh, gearset.planets)
    working = gearset.geometry.meshes[ring]
    radius, pitch = working.pitch_radii[ring], working.base_pitch
    pairs = pair_loads(gearbox, mesh, angle, force, train)
    half = 0.5 * pairs.face[..., None] * gearset.face_width * np.array([-1.0, 1.0])
    ends, direction = np.zeros((*half.shape, 3)), np.zeros((*half.shape[:2], 2))
    for flank in (DRIVE, COAST):
        rows = np.sign(force) == flank
        line = line_of_action(
            gearset.planet_angles[planet], radius, working.pressure_angle, flank, bool(ring)
        )
        lead = flank * math.tan(gearset.base_helix)  # of a slice, per way along the axis
        middle = pitch * pairs.ahead[rows, :, None] / lead if lead else 0.0
        place = pitch * pairs.position[rows, :, None] + lead * half[rows]
        ends[rows, ..., :2] = line.at(place)
        ends[rows, ..., 2] = middle + half[rows]
        direction[rows] = line.direction
    return Contacts(ends, direction, pairs.load)


def _strips(gearset: Gearset, mesh: Contacts, full: float) -> rr.ComponentColumnList:
    """One row per time, with a strip for each loaded pair."""
    carries = mesh.load > 0.0
    level = np.minimum(mesh.load[carries] / full, 1.0)
    front = (0.5 + _OVERHANG) * gearset.face_width
    bend = (
        mesh.load[carries, None]
        / full
        * _LONGEST
        * gearset.transverse.module
        * mesh.direction[carries]
    )
    strips = np.empty((len(level), 4, 3), dtype=np.float32)
    strips[:, :2] = mesh.ends[carries]
    strips[:, 2:, :2] = mesh.ends[carries][:, 1:, :2]
    strips[:, 3, :2] += bend
    strips[:, 2:, 2] = front
    return rr.LineStrips3D.columns(
        strips=MILLIMETRES * strips,
        colors=_shade(level),
        radii=MILLIMETRES * _THICKEST * gearset.transverse.module * (0.3 + 0.7 * level),
    ).partition(carries.sum(axis=1))


def _shade(level: Array) -> NDArray[np.uint8]:
    """Colours of loads over the full load, (n, 4)."""
    return np.asarray(colormaps[SHADES](level, bytes=True))


def _log_scale(layer: Layer, gearset: Gearset, full: float) -> None:
    """Colour bar of the loads, below the gears."""
    module = MILLIMETRES * gearset.transverse.module
    reach = 0.5 * gearset.teeth.ring * module
    left, width, y = -1.12 * reach, 0.5 * reach, -1.02 * reach
    below = y - 3.0 * module
    edges = left + width * np.linspace(0.0, 1.0, _BARS + 1)
    bars = np.zeros((_BARS, 2, 3), dtype=np.float32)
    bars[:, 0, 0], bars[:, 1, 0], bars[:, :, 1] = edges[:-1], edges[1:], y
    colours = _shade((np.arange(_BARS) + 0.5) / _BARS)
    bar = rr.LineStrips3D(list(bars), colors=colours, radii=0.5 * module)
    layer.log("gears/tooth_load/scale", bar, static=True)
    places = [(left, below), (left + 0.5 * width, y + 3.0 * module), (left + width, below)]
    labels = ["0", "Load of a tooth pair", figure(full, "N")]
    points = rr.Points3D(
        [(*place, 0.0) for place in places],
        labels=labels,
        radii=0.0,
        show_labels=True,
        colors=(200, 205, 215),
    )
    layer.log("gears/tooth_load/loads", points, static=True)
