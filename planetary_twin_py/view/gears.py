"""The gears as solids that turn: a scene graph of static meshes and rotations by columns.

/gears/sun, /gears/ring, /gears/carrier turn about the gearbox's axis; /gears/carrier/pin_i stands
on the carrier circle and carries /gears/carrier/pin_i/planet_i, which turns about its pin. Lengths
are drawn in millimetres: the viewer's camera and grid suit sizes of some tens, not of hundredths.
"""

from __future__ import annotations

import math

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from ..gearset.involute import SpurGear
from ..gearset.mount import mount
from ..gearset.solid import TriangleMesh, circle, extrude
from ..scene.sections import Gearset
from . import timeline
from .motion import Motion

MILLIMETRES = 1e3
SUN, PLANET, RING, CARRIER, PIN = (
    (236, 176, 64),
    (92, 150, 214),
    (150, 158, 170),
    (176, 98, 84),
    (210, 214, 220),
)
MARK = (250, 250, 250)  # of tooth 0, so that slow turning shows


def log_gears(recording: rr.RecordingStream, gearset: Gearset, motion: Motion) -> None:
    """Log the gearset's solids once and their rotations over time."""
    stand = mount(gearset.tooth_numbers, gearset.planet_angles)
    teeth, carrier = gearset.teeth, motion.angle["carrier"]
    _solid(recording, "gears/sun", sun(gearset), SUN, _gear(gearset, teeth.sun))
    _turn(recording, "gears/sun", motion, stand.sun + motion.angle["sun"])
    _solid(recording, "gears/ring", ring(gearset), RING, _gear(gearset, teeth.ring, True))
    _turn(recording, "gears/ring", motion, stand.ring + motion.angle["ring"])
    _solid(recording, "gears/carrier", spider(gearset), CARRIER)
    _turn(recording, "gears/carrier", motion, carrier)
    for i, psi in enumerate(gearset.planet_angles):
        at, name = f"gears/carrier/pin_{i + 1}", f"planet_{i + 1}"
        radius = MILLIMETRES * _carrier_radius(gearset)
        centre = rr.Transform3D(translation=[radius * math.cos(psi), radius * math.sin(psi), 0.0])
        recording.log(at, centre, static=True)
        _solid(recording, at, pin(gearset), PIN)
        _solid(recording, f"{at}/{name}", planet(gearset), PLANET, _gear(gearset, teeth.planet))
        _turn(recording, f"{at}/{name}", motion, stand.planets[i] + motion.angle[name] - carrier)


def sun(gearset: Gearset) -> TriangleMesh:
    """The sun: a toothed wheel with a bore for its shaft."""
    return _wheel(gearset, gearset.teeth.sun, bore=0.3)


def planet(gearset: Gearset) -> TriangleMesh:
    """A planet: a toothed wheel with a bore for its pin."""
    return _wheel(gearset, gearset.teeth.planet, bore=0.35)


def ring(gearset: Gearset) -> TriangleMesh:
    """The ring: an annulus with internal teeth, its rim two and a half modules thick."""
    gear = _gear(gearset, gearset.teeth.ring, internal=True)
    return _toothed_rim(gear, gear.root_radius + 2.5 * gear.module, 0.5 * gearset.face_width)


def pin(gearset: Gearset) -> TriangleMesh:
    """The pin that a planet turns on, from the carrier through the planet."""
    radius = 0.33 * _gear(gearset, gearset.teeth.planet).root_radius
    return extrude(0.0, circle(radius), -0.7 * gearset.face_width, 0.56 * gearset.face_width)


def spider(gearset: Gearset) -> TriangleMesh:
    """The carrier: a plate behind the gears with one arm per planet."""
    width = 0.6 * _gear(gearset, gearset.teeth.planet).root_radius
    hub = 0.9 * _gear(gearset, gearset.teeth.sun).root_radius
    angles = np.linspace(0.0, 2.0 * math.pi, 720, endpoint=False)
    radius = np.full_like(angles, hub)
    for psi in gearset.planet_angles:
        radius = np.maximum(radius, _arm(angles - psi, _carrier_radius(gearset), width))
    outline = np.column_stack((radius, angles))
    back = -0.54 * gearset.face_width
    return extrude(0.5 * hub, outline, back - 0.18 * gearset.face_width, back)


def _gear(gearset: Gearset, teeth: int, internal: bool = False) -> SpurGear:
    return SpurGear(teeth, gearset.module, gearset.pressure_angle, gearset.addendum, internal)


def _carrier_radius(gearset: Gearset) -> float:
    return 0.5 * gearset.module * (gearset.teeth.sun + gearset.teeth.planet)


def _arm(angle: NDArray[np.float64], length: float, width: float) -> NDArray[np.float64]:
    """Polar outline of an arm with a round end, of half `width`, along angle zero."""
    across, along = np.abs(np.sin(angle)), np.cos(angle)
    end = length * along + np.sqrt(np.maximum(width**2 - (length * across) ** 2, 0.0))
    side = np.minimum(width / np.maximum(across, 1e-12), length)
    reach = np.where(length * across <= width, end, side)
    return np.where(along > 0.0, reach, 0.0)


def _wheel(gearset: Gearset, teeth: int, bore: float) -> TriangleMesh:
    """Teeth on a rim, a thinner web inside it, and a hub around the bore."""
    half = 0.5 * gearset.face_width
    gear = _gear(gearset, teeth)
    root = gear.root_radius
    rim = max(root - 1.8 * gear.module, 0.7 * root)
    hub = min(1.35 * bore * root, 0.9 * rim)
    body = _toothed_rim(gear, rim, half) + extrude(bore * root, circle(hub), -half, half)
    return body + extrude(hub, circle(rim), -0.82 * half, 0.82 * half)


def _toothed_rim(gear: SpurGear, edge: float, half: float) -> TriangleMesh:
    """The teeth, and apart from them the plain rim between the root circle and radius `edge`."""
    outline = gear.outline()
    root = np.column_stack((np.full(len(outline), gear.root_radius), outline[:, 1]))
    if gear.internal:
        return extrude(outline, root, -half, half) + extrude(root, edge, -half, half)
    return extrude(root, outline, -half, half) + extrude(edge, root, -half, half)


def _solid(
    recording: rr.RecordingStream,
    path: str,
    solid: TriangleMesh,
    colour: tuple[int, int, int],
    gear: SpurGear | None = None,
) -> None:
    """Log a mesh once; of a gear, tooth 0 (around angle zero) is marked."""
    colours = np.tile(np.array(colour, dtype=np.uint8), (len(solid.vertices), 1))
    if gear is not None:
        colours[_of_tooth_zero(solid, gear)] = MARK
    mesh = rr.Mesh3D(
        vertex_positions=MILLIMETRES * solid.vertices,
        vertex_normals=solid.normals,
        triangle_indices=solid.faces,
        vertex_colors=colours,
    )
    recording.log(path, mesh, static=True)


def _of_tooth_zero(solid: TriangleMesh, gear: SpurGear) -> NDArray[np.bool_]:
    """Which vertices belong to faces (four vertices each) that lie wholly in tooth 0."""
    x, y, _ = solid.vertices.astype(np.float64).T
    foot = gear.half_thickness(np.array(gear.root_radius))
    depth = (np.hypot(x, y) - gear.root_radius) * (-1.0 if gear.internal else 1.0)
    inside = (np.abs(np.arctan2(y, x)) < 1.001 * foot) & (depth > -1e-3 * gear.module)
    return np.repeat(inside.reshape(-1, 4).all(axis=1), 4)


def _turn(
    recording: rr.RecordingStream, path: str, motion: Motion, angle: NDArray[np.float64]
) -> None:
    """Rotations about z by columns; a member that stands still gets one static rotation."""
    quaternions = np.zeros((len(angle), 4), dtype=np.float32)
    quaternions[:, 2], quaternions[:, 3] = np.sin(0.5 * angle), np.cos(0.5 * angle)
    if np.ptp(angle) == 0.0:
        still = rr.Transform3D(quaternion=rr.Quaternion(xyzw=quaternions[0]))
        recording.log(path, still, static=True)
        return
    rr.send_columns(
        path,
        timeline.columns(motion.time, motion.stamp),
        rr.Transform3D.columns(quaternion=quaternions),
        recording=recording,
    )
