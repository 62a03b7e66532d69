"""Axes that move: how far gears are drawn off their places, and arrows of the bearing forces.

Displacements are thousandths of a module, so they are drawn enlarged. Between two recorded states
the mean displacement of the intervals is interpolated, on the carrier, and then turned with it;
vibration within an interval is not drawn. Contacts of teeth stay at their nominal positions.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from ..recording.runs.reader import Recording
from ..recording.runs.series import Series
from ..robot.parts import carrier_radius
from ..scene.gearset import Gearset
from ..units.catalogue import COMPONENTS, MEMBERS
from ..units.engineering import figure
from . import timeline
from .gears import MILLIMETRES, Moved
from .layer import Layer
from .motion import Motion
from .round_numbers import round_down, round_up

Array = NDArray[np.float64]
_FAR = 1.0  # largest drawn displacement [modules]
_LONG = 0.35  # largest drawn arrow [radii of the planet centres]
_COLOUR = (120, 220, 140)
_THICK = 0.22  # radius of an arrow [modules]


class Scales(NamedTuple):
    """How axes that move are drawn."""

    magnification: float
    """Drawn over true displacement."""
    force: float
    """Force of the arrow at the scale [N]."""
    length: float
    """Length of that arrow [m]."""

    @property
    def text(self) -> str:
        """For the title of a view."""
        return f"axes displaced {self.magnification:g} times as far"


def scales(gearset: Gearset, axes: Series) -> Scales | None:
    """Scales at which the largest values in states of axes are well seen; None without states.

    Args:
        gearset: the gears.
        axes: states of the axes.
    """
    if not len(axes):
        return None
    far, force = (
        max(np.nanmax(axes[f"{body}_{name}"], initial=0.0) for body in COMPONENTS)
        for name in ("displacement_peak", "bearing_force_peak")
    )
    largest = _FAR * gearset.transverse.module / far if far > 0.0 else 1.0
    scale = round_up(force) if force > 0.0 else 1.0
    return Scales(round_down(largest), scale, _LONG * carrier_radius(gearset))


def moved(axes: Series, motion: Motion, gearset: Gearset, drawn: Scales) -> Moved:
    """Enlarged displacements of sun, ring and carrier in the housing, of planets on the carrier.

    Args:
        axes: states of the axes.
        motion: times and angles.
        gearset: the gears.
        drawn: the scales.

    Returns:
        By name of the body, x and y [m] at the times of the motion, (n, 2).
    """
    carrier = motion.angle["carrier"]
    displacements: dict[str, Array] = {}
    across = {body: _interpolated(axes, motion.time, f"{body}_displacement") for body in MEMBERS}
    for body, vectors in across.items():
        displacements[body] = drawn.magnification * turned(vectors, carrier)
    for i, psi in enumerate(gearset.planet_angles):
        displacement = turned(_interpolated(axes, motion.time, "planet_displacement", i), psi)
        displacements[f"planet_{i + 1}"] = drawn.magnification * (displacement - across["carrier"])
    return displacements


def log_axes(
    layer: Layer, recording: Recording, gearset: Gearset, motion: Motion, drawn: Scales
) -> None:
    """Log an arrow for the force of every body on its bearing, and the scale of the arrows.

    /gears/bearing_force/BODY is at rest in the housing; that of a planet moves with the carrier.
    Arrows are at the times of the states of the recording.

    Args:
        layer: recording to draw into.
        recording: recording to draw.
        gearset: the gears.
        motion: angles over time.
        drawn: the scales.
    """
    axes = recording.axes_state
    carrier = np.interp(axes.time, motion.time, motion.angle["carrier"])
    places = Motion(axes.time, axes.stamp, {"carrier": carrier})
    per_newton = MILLIMETRES * drawn.length / drawn.force
    index = timeline.columns(places.time, places.stamp)
    at = moved(axes, places, gearset, drawn)
    front, thick = 0.75 * gearset.face_width, MILLIMETRES * _THICK * gearset.transverse.module
    for body in MEMBERS:
        vectors = turned(_interpolated(axes, places.time, f"{body}_bearing_force"), carrier)
        shown = _Arrow(at[body], per_newton * vectors, front)
        _arrows(layer, f"gears/bearing_force/{body}", index, shown, thick)
    for i, psi in enumerate(gearset.planet_angles):
        vectors = turned(_interpolated(axes, places.time, "planet_bearing_force", i), psi)
        pin = carrier_radius(gearset) * np.array([math.cos(psi), math.sin(psi)])
        body = f"planet_{i + 1}"
        shown = _Arrow(pin + at[body], per_newton * vectors, front)
        _arrows(layer, f"gears/carrier/bearing_force/{body}", index, shown, thick)
    _log_scale(layer, gearset, drawn, thick)


def turned(vectors: Array, angle: Array | float) -> Array:
    """Vectors (n, 2) turned by an angle [rad], one or (n,).

    Args:
        vectors: (n, 2).
        angle: [rad], one or (n,).
    """
    along = vectors @ np.array([1.0, 1.0j]) * np.exp(1j * np.asarray(angle))
    return np.column_stack([along.real, along.imag])


def _interpolated(axes: Series, time: Array, name: str, planet: int | None = None) -> Array:
    """A mean vector of the intervals at `time` [s], interpolated between their middles, (n, 2)."""
    middle = axes.time - 0.5 * axes["interval"]
    body = "planet" if planet is not None else name.partition("_")[0]
    columns = [axes[f"{name}_{component}"] for component in COMPONENTS[body]]
    if planet is not None:
        columns = [column[:, planet] for column in columns]
    return np.column_stack([np.interp(time, middle, column) for column in columns])


class _Arrow(NamedTuple):
    """An arrow over time."""

    origin: Array  # (n, 2) [m]
    vector: Array  # (n, 2) [mm]
    front: float  # height of its plane [m]


def _arrows(
    layer: Layer, path: str, index: list[rr.TimeColumn], arrow: _Arrow, thick: float
) -> None:
    """Log an arrow over time, `thick` [mm]."""
    layer.log(path, rr.Arrows3D.from_fields(colors=[_COLOUR], radii=[thick]), static=True)
    rows = np.zeros((2, len(arrow.origin), 3), dtype=np.float32)
    rows[0, :, :2], rows[0, :, 2] = MILLIMETRES * arrow.origin, MILLIMETRES * arrow.front
    rows[1, :, :2] = arrow.vector
    layer.send_columns(path, index, rr.Arrows3D.columns(origins=rows[0], vectors=rows[1]))


def _log_scale(layer: Layer, gearset: Gearset, drawn: Scales, thick: float) -> None:
    """An arrow of known force below the gears, with the scale of displacements."""
    module = MILLIMETRES * gearset.transverse.module
    reach = 0.5 * gearset.teeth.ring * module
    length = MILLIMETRES * drawn.length
    start, y = 1.05 * reach - length, -1.02 * reach
    arrow = rr.Arrows3D(
        origins=[(start, y, 0.0)], vectors=[(length, 0.0, 0.0)], colors=[_COLOUR], radii=[thick]
    )
    layer.log("gears/bearing_force/scale", arrow, static=True)
    texts = {
        f"Bearing force {figure(drawn.force, 'N')}": y + 3.0 * module,
        f"Axes displaced x {drawn.magnification:g}": y - 3.0 * module,
    }
    points = rr.Points3D(
        [(start + 0.5 * length, height, 0.0) for height in texts.values()],
        labels=list(texts),
        radii=0.0,
        show_labels=True,
        colors=(200, 205, 215),
    )
    layer.log("gears/bearing_force/texts", points, static=True)
