"""Fields of a `Train` whose axes move: rows of meshes over displacements, and bearings.

The rows are those of `model.planar_rows`, in the order that `core/model/moving_axes.hpp` describes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np

from .._core import AXES, MovingAxes, RollingBearing
from ..scene.supports import Rolling, Support
from .bearing_pits import put_pits
from .bodies import Bodies, in_plane, tilts_of
from .layout import Layout
from .library import library
from .planar_rows import CENTRAL, COAST, DRIVE, PlanarRows
from .rolling_bearings import eccentricity, press, rolling_bearing
from .stiffness_laws import stiffness_follows_load
from .tilting_rows import row_of_scene

SIDES = (DRIVE, COAST)
LEAST_LOAD = 1.0  # [N] at which a rolling bearing without load is made linear
BEARING_DAMPING = 1.25e-5
"""Damping of a bearing over its stiffness [s], where a scene gives none: the middle of the range
0.25e-5 to 2.5e-5 s of Friswell, Penny, Garvey and Lees 2010, Dynamics of Rotating Machines."""


def linear_bearing(layout: Layout, name: str, torque: float) -> tuple[float, float]:
    """Linear bearing of a body.

    Args:
        layout: of a scene with supports.
        name: "sun", "ring", "carrier" or that of a planet, "planet_1".
        torque: of the first motor [N m].

    Returns:
        Radial stiffness [N/m] and damping [N s/m]: of a rolling bearing those along a nominal load,
        for a planet that of its pin, for the others a mesh force, which is of the size of what
        errors leave to them. They decide how fast the equations are solved, not the solution.
    """
    scene = layout.scene
    kind, _, number = name.partition("_")
    support: Support = getattr(scene.supports, kind)
    if support.rolling is None:
        factor = scene.errors.of_planet(int(number) - 1).pin_stiffness if number else 1.0
        stiffness = factor * (support.bearing or 0.0)
        return stiffness, default_damping(support.damping, stiffness)
    law, clearance = rolling_bearing(support.rolling), support.clearance
    load = max(abs(layout.mesh_force(torque)), LEAST_LOAD)
    if kind == "planet":
        load *= 2.0 * math.cos(scene.gearset.geometry.meshes[0].pressure_angle)
    size = np.array([eccentricity(law, clearance, load)])
    stiffness = float(press(law, clearance, size)[2, 0])
    return stiffness, law.damping_time * stiffness


def default_damping(damping: float | None, stiffness: float) -> float:
    """Damping of a bearing in one direction.

    Args:
        damping: that of the scene, if it gives one.
        stiffness: of the bearing.

    Returns:
        The damping, in the unit of the stiffness times seconds.
    """
    return BEARING_DAMPING * stiffness if damping is None else damping


def move_axes(layout: Layout, bodies: Bodies, groups: dict[str, dict[str, Any]]) -> MovingAxes:
    """Extend a train by the motion of its axes.

    Args:
        layout: of a scene with supports.
        bodies: with their displacements.
        groups: fields of the groups of `Train` with one entry for each mesh; changed to those of
            `_core.axes.Train`, with an entry for the drive flanks of each mesh and then for the
            coast flanks of each.

    Returns:
        Rows of the meshes over displacements, and bearings.
    """
    scene, meshes, frame = layout.scene, len(groups["mesh"]["kind"]), bodies.ground + 1
    body, sign, line = _entries(layout, bodies, frame)
    moving: MovingAxes = library(scene).MovingAxes(
        frame=frame,
        carrier=[bodies.place[f"carrier.{motion}"] for motion in "xy"],
        arm=scene.gearset.geometry.centre_distance,
        line=line,
        entries=body.shape[1],
        **_gravity(layout),
        **_bearings(layout, bodies),
    )
    for name, law in zip(layout.bearings, moving.rolling, strict=False):
        _fill_rolling(getattr(scene.supports, name.split("_")[0]).rolling, law)
    put_pits(layout, bodies, moving)
    if scene.tilting_axes:
        moving.slope_place, moving.slope = _slopes(layout, bodies)
        moving.face_square = scene.gearset.face_width**2 / 12.0
        _fill_tilting(layout, bodies, moving)
    for group, name in (
        ("mesh", "copies"), ("mesh", "kind"), ("mesh", "phase"), ("mesh", "stiffness_factor"),
        ("errors", "tangential"), ("errors", "radial"), ("errors", "phase"),
    ):  # fmt: skip
        groups[group][name] = np.concatenate([groups[group][name][:meshes]] * 2)
    pairs = groups["faults"]["pair"][:, :meshes]
    groups["faults"]["pair"] = np.concatenate([pairs] * 2, axis=1)
    lever = np.zeros((3, 2 * meshes))
    lever[:2] = 1.0 / bodies.radius[body[:, :2].T]
    groups["mesh"] |= {"body": body, "sign": sign, "lever": lever}
    groups["body"] |= {
        "copies": np.append(bodies.copies, 1),
        "mass": np.append(bodies.copies * bodies.mass, 0.0),
        "radius": np.append(bodies.radius, 1.0),
        "inverse_radius": np.append(1.0 / bodies.radius, 1.0),
        "ratio": np.vstack([bodies.ratio, _turning(layout)]),
    }
    return moving


def _turning(layout: Layout) -> np.ndarray:
    """Speed of the carrier and of the frame per speed of each input, (AXES,)."""
    ratios = layout.ratios["carrier"]
    return np.array([float(ratio) for ratio in ratios] + [0.0] * (AXES - len(ratios)))


def _entries(
    layout: Layout, bodies: Bodies, frame: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Coordinates, row, and turn of the line of action of each entry, (entries, n) each."""
    gears, rows, count = layout.scene.gearset.geometry, layout.rows, len(layout.planets)
    angles = [mesh.pressure_angle for mesh in gears.meshes]
    body, sign, line = [], [], []
    for side, name, number in _meshes(layout):
        i, planet = number + count * (name == "ring"), layout.planets[number]
        first, second = (planet, name) if name == "ring" else (name, planet)
        turns = [f"{first}.u", f"{second}.u"]
        moves = [f"{gear}.{motion}" for gear in (first, second) for motion in in_plane(gear)]
        places = [rows.place(coordinate) for coordinate in (*turns, *moves)]
        row = rows.tangential[i, places] + side * rows.radial[i, places]
        beyond, factors = _beyond_plane(layout, side, name, number)
        body.append(
            [bodies.place[first], bodies.place[second], frame]
            + [bodies.place[coordinate] for coordinate in (*moves, *beyond)]
        )
        sign.append([*row[:2], 0.0, *row[2:], *factors])
        turn = _turn_of_line(rows, i, side, angles[i // count], moves)
        line.append([0.0, 0.0, 0.0, *(turn / gears.centre_distance)])
    return np.array(body), np.array(sign), np.array(line)


def _meshes(layout: Layout) -> Iterator[tuple[float, str, int]]:
    """Side, central gear and planet (counted from 0) of each entry, in the order of the core."""
    for side in SIDES:
        for name in ("sun", "ring"):
            for number in layout.groups.leaders:
                yield side, name, number


def _beyond_plane(
    layout: Layout, side: float, name: str, number: int
) -> tuple[list[str], list[float]]:
    """Axial displacements and tilts of both gears of an entry, and their factors in its row."""
    if not layout.scene.tilting_axes:
        return [], []
    row, radii = row_of_scene(layout.scene, side, name, number), layout.planar_radii
    coordinates, factors = [], []
    for k, (gear, kind) in enumerate(((name, name), (layout.planets[number], "planet"))):
        coordinates += [f"{gear}.{motion}" for motion in ("z", *tilts_of(gear))]
        factors += [float(row.axial[k]), *(row.tilt[k] / radii[kind]).tolist()]
    return coordinates, factors


def _slopes(layout: Layout, bodies: Bodies) -> tuple[np.ndarray, np.ndarray]:
    """Tilts of both gears of each entry, and the slope of its deflection per tilt, (entries, 4)."""
    radii, places, slopes = layout.planar_radii, [], []
    for side, name, number in _meshes(layout):
        row, planet = row_of_scene(layout.scene, side, name, number), layout.planets[number]
        places.append([bodies.place[f"{g}.{m}"] for g in (name, planet) for m in tilts_of(g)])
        slopes.append([*(row.slope[0] / radii[name]), *(row.slope[1] / radii["planet"])])
    return np.array(places), np.array(slopes)


def _fill_tilting(layout: Layout, bodies: Bodies, moving: MovingAxes) -> None:
    """Fill axial and tilting motion of all bearings, in their order."""
    supports, radii = layout.scene.supports, layout.planar_radii
    polar, diametral = layout.polar_masses, layout.tilting_masses
    for name, axis in zip(layout.bearings, moving.tilting, strict=False):
        kind = name.split("_")[0]
        support, r = getattr(supports, kind), radii[kind]
        axis.axial = bodies.place[f"{name}.z"]
        axis.place = [bodies.place[f"{name}.{motion}"] for motion in tilts_of(name)]
        axis.lever, axis.turns = 1.0 / r, bodies.place[name]
        axis.axial_stiffness, axis.tilting_stiffness = support.axial, support.tilting * r**2
        axis.axial_damping = default_damping(support.axial_damping, support.axial)
        tilting_damping = default_damping(support.tilting_damping, support.tilting)
        axis.tilting_damping = tilting_damping * r**2
        axis.diametral, axis.polar = diametral[kind] * r**2, polar[kind] * r**2


def _turn_of_line(
    rows: PlanarRows, mesh: int, side: float, angle: float, moves: list[str]
) -> np.ndarray:
    """Turn of the line of action per displacement of the gears over the centre distance, (4,).

    The line touches both base circles, at points that are a sin(angle) apart, a the centre
    distance. Displacements across the line move one of these points past the other. Along it the
    gears approach by T + side R per displacement: its direction has side cos(angle) across and
    sin(angle) outwards from the sun, and by a right angle on, the share of T becomes that of R.
    """
    place = [rows.place(name) for name in moves]
    across = rows.tangential[mesh, place] / math.cos(angle)
    outwards = rows.radial[mesh, place] / math.sin(angle)
    return side * outwards / math.tan(angle) - across


def _bearings(layout: Layout, bodies: Bodies) -> dict[str, Any]:
    """Fields of `MovingAxes` over the bearings of sun, ring, carrier and planets.

    Every planet has its own bearing, also where planets of the same motion share displacements.
    """
    scene, names = layout.scene, layout.bearings
    supports, planets = scene.supports, scene.gearset.planets
    assert supports is not None  # the scene has been checked
    held = [getattr(supports, kind) for kind in CENTRAL] + [supports.planet] * planets
    torque = scene.operating_point.input_torque if stiffness_follows_load(scene) else 0.0
    linear = [linear_bearing(layout, name, torque) for name in names]
    angles, errors = scene.gearset.planet_angles, scene.pins
    pin = 1.0 / math.cos(scene.gearset.geometry.meshes[0].pressure_angle)
    return {
        "bearings": len(names),
        "leads": [True] * 3 + [planet in layout.leaders for planet in layout.planets],
        "place": [[bodies.place[f"{name}.{m}"] for m in in_plane(name)] for name in names],
        "direction": [[0.0, 0.0]] * 3 + [[math.cos(a), math.sin(a)] for a in angles],
        "carried": [0.0] * 3 + [pin] * planets,
        "mass": [support.mass for support in held],
        "stiffness": [stiffness for stiffness, _ in linear],
        "damping": [damping for _, damping in linear],
        "clearance": [support.clearance for support in held],
        "centre": [(0.0, 0.0)] * 3 + [errors.of_planet(i)[:2] for i in range(planets)],
    }


def _fill_rolling(rolling: Rolling | None, law: RollingBearing) -> None:
    if rolling is None:
        return
    given = rolling_bearing(rolling)
    for name in ("strength", "exponent", "load_zone", "damping_time"):
        setattr(law, name, getattr(given, name))


def _gravity(layout: Layout) -> dict[str, Any]:
    """Fields of `MovingAxes` for the weight of the bodies."""
    supports, ratios = layout.scene.supports, layout.ratios["carrier"]
    assert supports is not None  # the scene has been checked
    per_turn = [*ratios, *[Fraction(0)] * (AXES - len(ratios))]
    return {
        "gravity": supports.gravity,
        "downwards": supports.gravity_direction,
        "turn_numerator": [ratio.numerator for ratio in per_turn],
        "turn_denominator": [ratio.denominator for ratio in per_turn],
    }
