"""The gears as rotating solids: a scene graph of static meshes and rotations over time.

/gears/sun, /gears/ring and /gears/carrier rotate about the axis of the gearbox;
/gears/carrier/pin_i is fixed to the carrier, and /gears/carrier/pin_i/planet_i rotates about its
pin. Lengths are in millimetres, because the camera of the viewer suits numbers of that size.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from ..gearset.involute import SpurGear
from ..gearset.solid import TriangleMesh
from ..robot.parts import (
    CARRIER,
    MARK,
    PIN,
    PLANET,
    RING,
    SUN,
    carrier_radius,
    pin,
    planet,
    ring,
    spider,
    sun,
)
from ..scene.gearset import Gearset
from . import timeline
from .layer import Layer
from .motion import Motion

MILLIMETRES = 1e3


def log_gears(layer: Layer, gearset: Gearset) -> None:
    """Log the gearset's solids.

    Args:
        layer: recording to draw into.
        gearset: the gears.
    """
    gears, twist = gearset.geometry, gearset.twist
    _gear(layer, "gears/sun", sun(gearset), SUN, gears.sun, twist.sun)
    _gear(layer, "gears/ring", ring(gearset), RING, gears.ring, twist.ring)
    _solid(layer, "gears/carrier", spider(gearset), CARRIER)
    for i, psi in enumerate(gearset.planet_angles):
        radius = MILLIMETRES * carrier_radius(gearset)
        centre = rr.Transform3D(translation=[radius * math.cos(psi), radius * math.sin(psi), 0.0])
        layer.log(_pin(i), centre, static=True)
        _solid(layer, _pin(i), pin(gearset), PIN)
        _gear(layer, _planet(i), planet(gearset), PLANET, gears.planet, twist.planet)


Moved = Mapping[str, NDArray[np.float64]]
"""Displacements as drawn, x and y [m] (n, 2), by name of the body."""


def log_motion(layer: Layer, gearset: Gearset, motion: Motion, moved: Moved | None = None) -> None:
    """Log the rotation of the solids, and their displacements if axes move.

    Args:
        layer: recording to draw into.
        gearset: the gears.
        motion: angles at n times.
        moved: displacements at these times, of planets against the carrier.
    """
    stand = gearset.mounted
    carrier = motion.angle["carrier"]
    angles = {
        "gears/sun": stand.sun + motion.angle["sun"],
        "gears/ring": stand.ring + motion.angle["ring"],
        "gears/carrier": carrier,
    }
    for i, offset in enumerate(stand.planets):
        angles[_planet(i)] = offset + motion.angle[f"planet_{i + 1}"] - carrier
    for path, angle in angles.items():
        body = path.rpartition("/")[2]
        _turn(layer, path, motion, angle, None if moved is None else moved[body])


def _pin(i: int) -> str:
    return f"gears/carrier/pin_{i + 1}"


def _planet(i: int) -> str:
    return f"{_pin(i)}/planet_{i + 1}"


Colour = tuple[int, int, int]


def _gear(
    layer: Layer, path: str, solid: TriangleMesh, colour: Colour, gear: SpurGear, twist: float
) -> None:
    """Log a gear; its tooth 0, at angle zero in the middle of the face, is marked."""
    _solid(layer, path, solid, colour, _of_tooth_zero(solid.twisted(-twist), gear))


def _solid(
    layer: Layer,
    path: str,
    solid: TriangleMesh,
    colour: Colour,
    marked: NDArray[np.bool_] | None = None,
) -> None:
    """Log a static mesh, some of its vertices marked."""
    colours = np.tile(np.array(colour, dtype=np.uint8), (len(solid.vertices), 1))
    if marked is not None:
        colours[marked] = MARK
    mesh = rr.Mesh3D(
        vertex_positions=MILLIMETRES * solid.vertices,
        vertex_normals=solid.normals,
        triangle_indices=solid.faces,
        vertex_colors=colours,
    )
    layer.log(path, mesh, static=True)


def _of_tooth_zero(solid: TriangleMesh, gear: SpurGear) -> NDArray[np.bool_]:
    """Whether each vertex belongs to a face (four vertices) that is entirely in tooth 0."""
    x, y, _ = solid.vertices.astype(np.float64).T
    foot = gear.half_thickness(np.array(gear.root_radius))
    depth = (np.hypot(x, y) - gear.root_radius) * (-1.0 if gear.internal else 1.0)
    inside = (np.abs(np.arctan2(y, x)) < 1.001 * foot) & (depth > -1e-3 * gear.module)
    return np.repeat(inside.reshape(-1, 4).all(axis=1), 4)


def _turn(
    layer: Layer,
    path: str,
    motion: Motion,
    angle: NDArray[np.float64],
    moved: NDArray[np.float64] | None,
) -> None:
    """Log rotations about z and displacements; for a member at rest, only the first."""
    rows = slice(0, 1 if np.ptp(angle) == 0.0 and moved is None else len(angle))
    quaternions = np.zeros((len(angle[rows]), 4), dtype=np.float32)
    quaternions[:, 2], quaternions[:, 3] = np.sin(0.5 * angle[rows]), np.cos(0.5 * angle[rows])
    index = timeline.columns(motion.time[rows], motion.stamp[rows])
    where = None
    if moved is not None:
        where = np.zeros((len(moved), 3), dtype=np.float32)
        where[:, :2] = MILLIMETRES * moved
    columns = rr.Transform3D.columns(quaternion=quaternions, translation=where)
    layer.send_columns(path, index, columns)
