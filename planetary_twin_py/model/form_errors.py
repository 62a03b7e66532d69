"""Errors of form and position: the static transmission error e of the teeth of a mesh.

The deflection of a mesh on one side (side = +1 or -1) is side (d - e) - b, where b is half the
backlash. e = e_T + side e_R: the tangential part e_T shifts both flanks of a tooth in the same
direction; the radial part e_R moves both flanks away from the other gear and increases the
backlash. Harmonics of the meshing frequency have e_T only. Runout repeats with each turn of a gear
and has both parts, at the pressure angle, with opposite sign on the other flank. Errors of pins,
planet teeth and axes have both parts, too. All errors are sines of the mesh cycle,
e_T = a sin(angle) and e_R = b cos(angle). Where axes move, errors of pins are displacements of
bearings instead, and the axes of ring and carrier move from where their bearings hold them, which
is at rest in the housing.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from .._core import LINES, MESHES
from ..scene.mesh import TransmissionError
from .layout import Layout

CONSTANT = 0.25 * math.pi  # angle of a line that does not turn: it has both parts


class _Line(NamedTuple):
    """A sine in every mesh of one kind."""

    harmonic: float
    """Number of sines ..."""
    period: int
    """... in so many mesh cycles."""
    tangential: np.ndarray
    """a [m], (planets that are integrated,)."""
    radial: np.ndarray
    """b [m], likewise."""
    phase: np.ndarray
    """Angle at cycle 0 [rad], likewise."""
    of_planet: bool = False
    """Whether the cycles are those of the sun mesh of the planet."""


def build_form_errors(layout: Layout) -> dict[str, Any]:
    """Fields of the form errors of `Train`."""
    mesh, count = layout.scene.mesh, len(layout.leaders)
    kinds = [
        _harmonics(error, count) + _runout(layout, kind) + _positions(layout, kind)
        for kind, error in enumerate((mesh.sun_planet_error, mesh.planet_ring_error))
    ]
    for lines in kinds:
        lines.sort(key=lambda line: bool(line.radial.any()))  # those without it first
    harmonic, of_planet = np.zeros((2, LINES)), np.zeros((2, LINES), dtype=int)
    period = np.ones((2, LINES), dtype=int)
    tangential, radial, phase = (np.zeros((MESHES, LINES)) for _ in range(3))
    for kind, lines in enumerate(kinds):
        own = slice(kind * count, (kind + 1) * count)
        for place, line in enumerate(lines):
            harmonic[kind, place], period[kind, place] = line.harmonic, line.period
            of_planet[kind, place] = line.of_planet
            tangential[own, place], radial[own, place] = line.tangential, line.radial
            phase[own, place] = line.phase
    return {
        "lines": np.array([len(lines) for lines in kinds]),
        "harmonics": np.array([sum(not line.radial.any() for line in lines) for lines in kinds]),
        "tangential": tangential,
        "radial": radial,
        "harmonic": harmonic,
        "period": period,
        "phase": phase,
        "of_planet": of_planet,
    }


def _harmonics(error: TransmissionError, count: int) -> list[_Line]:
    phases = error.phases or (0.0,) * len(error.amplitudes)
    one = np.ones(count)
    return [
        _Line(n, 1, a * one, 0.0 * one, phase * one)
        for n, (a, phase) in enumerate(zip(error.amplitudes, phases, strict=True), 1)
        if a != 0.0
    ]


def _runout(layout: Layout, kind: int) -> list[_Line]:
    """Lines a sin(turn + side sign phi) of the gears of a mesh with working pressure angle phi.

    If the toothing is displaced from the axis by a, in the direction phi_g from the radius of the
    planet, the sun has e_T = -a cos(phi) sin(phi_g) and e_R = -a sin(phi) cos(phi_g). The ring has
    the same e_T and the opposite e_R; the planet has the opposite of both, in both meshes (first
    order in a). The sun turns in the opposite direction to the others.
    """
    scene, leaders = layout.scene, layout.groups.leaders
    teeth, runout, errors = scene.gearset.tooth_numbers, scene.mesh.runout, scene.errors
    angle = scene.gearset.geometry.meshes[kind].pressure_angle
    one = np.ones(len(leaders))
    own = -np.array([errors.of_planet(i).runout_phase for i in leaders])
    central = ("ring", 1.0, -errors.ring_runout_phase * one) if kind else (
        "sun", 1.0, errors.sun_runout_phase * one
    )  # fmt: skip
    found = []
    for gear, sign, phase in (central, ("planet", 1.0 if kind else -1.0, own)):
        size = getattr(runout, gear)
        if size != 0.0:
            across, along = size * math.cos(angle), sign * size * math.sin(angle)
            period, of_planet = getattr(teeth, gear), gear == "planet"
            found.append(_Line(1.0, period, across * one, along * one, phase, of_planet))
    return found


def loaded_side(layout: Layout) -> float:
    """Side of the flanks that the torque of the operating point loads, +1: drive, -1: coast."""
    return math.copysign(1.0, layout.mesh_force(layout.scene.operating_point.input_torque))


def _positions(layout: Layout, kind: int) -> list[_Line]:
    """Lines of displaced pins and axes, and of thicker or more worn teeth."""
    scene, leaders = layout.scene, layout.groups.leaders
    errors, angle = scene.pins, scene.gearset.geometry.meshes[kind].pressure_angle
    outwards, across, thicker = np.array([errors.of_planet(i)[:3] for i in leaders]).T
    if scene.moving_axes:
        outwards, across = np.zeros((2, len(leaders)))
    sign = -1.0 if kind else 1.0
    tangential = math.cos(angle) * across
    radial = sign * math.sin(angle) * outwards - 0.5 * math.cos(angle) * thicker
    # Missing material of the loaded flanks alone: half of it on both flanks, half of it moves them.
    worn = 0.5 * np.array([scene.mesh.worn.of_planet(i)[kind] for i in leaders])
    tangential, radial = tangential + loaded_side(layout) * worn, radial + worn
    found = []
    if tangential.any() or radial.any():
        found.append(
            _Line(
                0.0,
                1,
                tangential / math.sin(CONSTANT),
                radial / math.cos(CONSTANT),
                np.full(len(leaders), CONSTANT),
            )
        )
    carried, offset = errors.carrier_offset, errors.ring_offset
    moved = carried.size * np.exp(1j * carried.angle)
    if kind:
        moved -= offset.size * np.exp(1j * offset.angle)
    if moved:
        found.append(_offset(layout, kind, moved))
    return found


def _offset(layout: Layout, kind: int, moved: complex) -> _Line:
    """Line of all planets displaced by `moved` [m], x + i y in the housing, against sun or ring.

    Against the radius of a planet it points by phi_g = its direction - planet angle - angle of the
    carrier, which the mesh cycles give: e_T = size cos(phi) sin(phi_g) and
    e_R = +-size sin(phi) cos(phi_g).
    """
    gearset, leaders = layout.scene.gearset, layout.groups.leaders
    turns = layout.ratios["carrier"][0] / layout.cycles[0]
    angle = gearset.geometry.meshes[kind].pressure_angle
    planets = np.array([gearset.planet_angles[i] for i in leaders])
    phases = np.array([float(layout.phases[kind][i]) for i in leaders])
    start = planets + 2.0 * np.pi * float(turns) * phases - float(np.angle(moved))
    size, one = abs(moved), np.ones(len(leaders))
    across, along = -size * math.cos(angle), size * math.sin(angle) * (-1.0 if kind else 1.0)
    return _Line(float(turns.numerator), turns.denominator, across * one, along * one, start)
