"""Errors of a scene as displacements of toothings and pins.

An eccentric toothing acts as if its gear were displaced by the same vector. Thicker teeth reduce
the backlash on both sides of a mesh.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..model.form_errors import loaded_side
from ..model.layout import Layout
from ..scene.errors import Offset


class Displacements(NamedTuple):
    """Errors at P angles of the first motor."""

    toothing: np.ndarray
    """Displacements of the toothings on their gears [m], (P, coordinates)."""
    pin: np.ndarray
    """Displacements of the pins on the carrier, radial and tangential [m], (planets, 2)."""
    axis: np.ndarray
    """Displacements x, y of the bearings of sun, ring and carrier [m], (P, 3, 2)."""
    closing: np.ndarray
    """Reduction of the backlash of each mesh by thicker teeth, on either side [m], (meshes,)."""
    worn: np.ndarray
    """Missing material of the drive and the coast flanks of each mesh [m], (2, meshes)."""


def displacements(layout: Layout, turns: np.ndarray) -> Displacements:
    """Errors of a scene.

    Args:
        layout: of the scene with the errors.
        turns: turns of the first motor, (P,); a second motor is at rest.

    Returns:
        The displacements, in the frame of the carrier.
    """
    scene = layout.scene
    errors, planets = scene.pins, scene.gearset.planets
    radial, tangential, thicker = (
        np.array(values or (0.0,) * planets)
        for values in (errors.pin_radial, errors.pin_tangential, errors.planet_thickness)
    )
    angle = {name: 2.0 * np.pi * float(r[0]) * turns for name, r in layout.ratios.items()}
    axis = np.zeros((len(turns), 3, 2))
    for place, offset in ((1, errors.ring_offset), (2, errors.carrier_offset)):
        axis[:, place] = _in_carrier_frame(offset, angle["carrier"])
    cosines = [math.cos(mesh.pressure_angle) for mesh in scene.gearset.geometry.meshes]
    return Displacements(
        _toothings(layout, angle),
        np.column_stack([radial, tangential]),
        axis,
        np.concatenate([thicker * cosine / 2.0 for cosine in cosines]),
        _worn(layout),
    )


def _worn(layout: Layout) -> np.ndarray:
    """Wear of each planet beyond the mean, on the loaded flanks [m], (2, meshes)."""
    planets = range(layout.scene.gearset.planets)
    depths = np.array([layout.scene.mesh.worn.of_planet(i) for i in planets]).T.ravel()
    loaded = np.array([[loaded_side(layout) > 0.0], [loaded_side(layout) < 0.0]])
    return np.asarray(loaded * depths)


def _in_carrier_frame(offset: Offset, carrier: np.ndarray) -> np.ndarray:
    direction = offset.angle - carrier
    return offset.size * np.column_stack([np.cos(direction), np.sin(direction)])


def _toothings(layout: Layout, angle: dict[str, np.ndarray]) -> np.ndarray:
    """Displacements by runout, with the start angles of `model.form_errors`."""
    scene, rows = layout.scene, layout.rows
    runout, errors, teeth = scene.mesh.runout, scene.errors, scene.gearset.tooth_numbers
    carrier, first = angle["carrier"], scene.gearset.planet_angles[0]
    sun_phases, ring_phases = layout.phases
    displaced = np.zeros((len(carrier), len(rows.coordinates)))
    # The part of the phase of a ring mesh that is independent of the planet's position.
    offset = 2.0 * np.pi * float(ring_phases[0]) / teeth.ring
    for gear, size, start in (
        ("sun", runout.sun, first + math.pi + errors.sun_runout_phase),
        ("ring", runout.ring, first + offset + errors.ring_runout_phase),
    ):
        direction = angle[gear] - carrier + start
        displaced[:, rows.place(f"{gear}.x")] = size * np.cos(direction)
        displaced[:, rows.place(f"{gear}.y")] = size * np.sin(direction)
    phases = errors.planet_runout_phases or (0.0,) * scene.gearset.planets
    for i, (planet, phase) in enumerate(zip(layout.planets, phases, strict=True)):
        start = math.pi + 2.0 * np.pi * float(sun_phases[i]) / teeth.planet + phase
        direction = angle["planet"] - carrier + start
        displaced[:, rows.place(f"{planet}.xi")] = runout.planet * np.cos(direction)
        displaced[:, rows.place(f"{planet}.eta")] = runout.planet * np.sin(direction)
    return displaced
