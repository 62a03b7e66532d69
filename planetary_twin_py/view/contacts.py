"""Tooth pairs in contact: a line across the tooth width where two flanks touch.

Brighter and thicker as the pair carries more; its front end is bent the way the first gear pushes
the second, by a length in proportion to the load. The flank is that which carries (drive or coast);
a mesh that is open has no line. /gears/carrier/contact/MESH moves with the carrier, in which the
contact runs along a line that stands still.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from ..dynamics.stiffness_laws import stiffness_laws
from ..gearset.geometry import base_pitch, pitch_radius, planet_ring_path, sun_planet_path
from ..gearset.line_of_action import COAST, DRIVE, line_of_action
from ..gearset.phasing import mesh_phases
from ..mesh.tooth_pairs import PAIRS, PairTable, pair_table
from ..recording.reader import Recording
from ..scene import Scene
from ..scene.gearset import Gearset
from . import timeline
from .colour_map import shade
from .gears import MILLIMETRES
from .layer import Layer
from .motion import Motion
from .round_numbers import one_digit

Array = NDArray[np.float64]
_FULL = 0.99  # share of the contacts whose load the scale spans; rare impacts go beyond
_OVERHANG = 0.06  # of the face width, so that the end shows before the face of the gears
_THICKEST, _LONGEST = 0.24, 3.0  # radius and bend at the full load [modules]
_BARS = 48  # steps of the drawn scale
_NEAR = 2e-4  # [s] within which a sample counts as that of an instant


@dataclass(frozen=True)
class Contacts:
    """Tooth pairs of one mesh at n instants, p at most: all (n, p), or (n, p, 2).

    `point` [m] seen from the carrier; unit `push`; `load` [N], 0 where no pair touches.
    """

    point: Array
    push: Array
    load: Array


def log_contacts(layer: Layer, scene: Scene, recording: Recording, motion: Motion) -> None:
    """Log the tooth pairs in contact at the instants of `motion`, and the scale of their loads."""
    force = forces(recording, motion.time)
    found = [
        contacts(scene, mesh, motion.angle["sun"] - motion.angle["carrier"], force[:, mesh])
        for mesh in range(len(recording.meshes))
    ]
    loads = np.concatenate([mesh.load[mesh.load > 0.0] for mesh in found])
    if not len(loads):
        return
    full = one_digit(float(np.quantile(loads, _FULL)))
    index = timeline.columns(motion.time, motion.stamp)
    for name, mesh in zip(recording.meshes, found, strict=True):
        columns = _strips(scene.gearset, mesh, full)
        layer.send_columns(f"gears/carrier/contact/{name}", index, columns)
    _log_scale(layer, scene.gearset, full)


def forces(recording: Recording, time: Array) -> Array:
    """Forces of the meshes [N] at `time` [s] (n,), shape (n, meshes).

    The sample at that instant; where the waveform has none, the mean of the interval.
    """
    state = recording.state
    row = np.minimum(np.searchsorted(state.time, time), len(state) - 1)
    force = np.nan_to_num(recording.per_mesh("mesh_force_mean"))[row]
    wave = recording.waveform
    if wave is None or len(wave.time) < 2:
        return force
    after = np.clip(np.searchsorted(wave.time, time), 1, len(wave.time) - 1)
    nearest = np.where(time - wave.time[after - 1] < wave.time[after] - time, after - 1, after)
    there = np.abs(wave.time[nearest] - time) < _NEAR
    force[there] = wave.mesh_force[nearest[there]]
    return force


def contacts(scene: Scene, mesh: int, sun_angle: Array, force: Array) -> Contacts:
    """Tooth pairs of a mesh that carry its `force` [N] (n,) at `sun_angle` [rad] (n,).

    `mesh` counts as in a recording; the angle is the sun's against the carrier. Pairs share the
    force as the scene's law of stiffness has it; faulty teeth count as healthy ones.
    """
    gearset, angle = scene.gearset, scene.gearset.pressure_angle
    ring, planet = divmod(mesh, gearset.planets)
    phase = float(mesh_phases(gearset.tooth_numbers, gearset.planet_angles)[ring][planet])
    cycle = gearset.teeth.sun * sun_angle / (2.0 * math.pi) - phase
    teeth = gearset.teeth.ring if ring else gearset.teeth.sun
    radius, pitch = pitch_radius(teeth, gearset.module), base_pitch(gearset.module, angle)
    table = _table(scene, ring)
    shape = (len(cycle), PAIRS)
    found = Contacts(np.zeros((*shape, 2)), np.zeros((*shape, 2)), np.zeros(shape))
    for flank in (DRIVE, COAST):
        rows = np.flatnonzero(np.sign(force) == flank)
        # The coast flanks see the motion mirrored, half a pitch later.
        own = flank * cycle[rows] + (0.5 if flank == COAST else 0.0)
        position, share = _pairs(table, own - np.floor(own))
        line = line_of_action(gearset.planet_angles[planet], radius, angle, flank, bool(ring))
        found.point[rows] = line.at(pitch * position)
        found.push[rows] = line.direction
        found.load[rows] = share * np.abs(force[rows, None])
    return found


def _table(scene: Scene, kind: int) -> PairTable:
    gearset, law = scene.gearset, stiffness_laws(scene)[kind]
    path = (sun_planet_path, planet_ring_path)[kind]
    reach = path(gearset.tooth_numbers, gearset.pressure_angle, gearset.addendum)
    return pair_table(reach, scene.mesh.ramp, law.strength, law.sharing)


def _pairs(table: PairTable, cycle: Array) -> tuple[Array, Array]:
    """Positions [base pitches] and shares in the force of the pairs at cycles in [0, 1), (n, p)."""
    segment = np.searchsorted(table.edge[1 : table.segments], cycle, side="right")
    into = (cycle - table.edge[segment])[:, None]
    coefficients = table.weight[segment, :PAIRS]
    weight = np.zeros((len(cycle), PAIRS))
    for term in range(coefficients.shape[-1] - 1, -1, -1):
        weight = weight * into + coefficients[..., term]
    weight = np.where(table.present[segment], np.maximum(weight, 0.0), 0.0)
    share = weight / weight.sum(axis=1, keepdims=True)
    return cycle[:, None] + table.shift[segment], share


def _strips(gearset: Gearset, mesh: Contacts, full: float) -> rr.ComponentColumnList:
    """One row per instant, with a strip for each pair that carries a load."""
    carries = mesh.load > 0.0
    level = np.minimum(mesh.load[carries] / full, 1.0)
    half = 0.5 * gearset.face_width
    front = half * (1.0 + 2.0 * _OVERHANG)
    bend = mesh.load[carries, None] / full * _LONGEST * gearset.module * mesh.push[carries]
    strips = np.empty((len(level), 3, 3), dtype=np.float32)
    strips[:, :2, :2] = mesh.point[carries][:, None]
    strips[:, 2, :2] = mesh.point[carries] + bend
    strips[:, :, 2] = (-half, front, front)
    return rr.LineStrips3D.columns(
        strips=MILLIMETRES * strips,
        colors=shade(level),
        radii=MILLIMETRES * _THICKEST * gearset.module * (0.3 + 0.7 * level),
    ).partition(carries.sum(axis=1))


def newtons(force: float) -> str:
    """A force as people write it: 900 N, 20 kN, 3 MN."""
    for size, unit in ((1e6, "MN"), (1e3, "kN")):
        if force >= size:
            return f"{force / size:g} {unit}"
    return f"{force:g} N"


def _log_scale(layer: Layer, gearset: Gearset, full: float) -> None:
    """A bar of colours below the gears, with its loads."""
    module = MILLIMETRES * gearset.module
    reach = 0.5 * gearset.teeth.ring * module
    left, width, y = -1.12 * reach, 0.5 * reach, -1.02 * reach
    below = y - 3.0 * module
    edges = left + width * np.linspace(0.0, 1.0, _BARS + 1)
    bars = np.zeros((_BARS, 2, 3), dtype=np.float32)
    bars[:, 0, 0], bars[:, 1, 0], bars[:, :, 1] = edges[:-1], edges[1:], y
    colours = shade((np.arange(_BARS) + 0.5) / _BARS)
    bar = rr.LineStrips3D(list(bars), colors=colours, radii=0.5 * module)
    layer.log("gears/tooth_load/scale", bar, static=True)
    places = [(left, below), (left + 0.5 * width, y + 3.0 * module), (left + width, below)]
    labels = ["0", "Load of a tooth pair", newtons(full)]
    points = rr.Points3D(
        [(*place, 0.0) for place in places],
        labels=labels,
        radii=0.0,
        show_labels=True,
        colors=(200, 205, 215),
    )
    layer.log("gears/tooth_load/loads", points, static=True)
