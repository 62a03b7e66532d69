"""The bodies of a scene as arrays: names, inertias, radii and speed ratios."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from .._core import AXES, Report
from .layout import Layout, Ratios
from .library import library
from .planar_rows import CENTRAL


class BodyNames(NamedTuple):
    """Map from the reported bodies to the integrated bodies."""

    names: tuple[str, ...]  # ("sun", "planet_1", ..., "ring", "carrier")
    place: np.ndarray  # (bodies,) index in the arrays of `Train`
    ratio: tuple[Ratios, ...]


class MeshNames(NamedTuple):
    """Map from the reported meshes to the integrated meshes."""

    names: tuple[str, ...]  # ("sun_planet_1", ..., "planet_ring_1", ...)
    place: np.ndarray  # (meshes,) index in the arrays of `Train`, of the flanks that carry


class Bodies(NamedTuple):
    """Arrays over the bodies that can turn: planets, then members that are not held, then machines.

    The last entry is the ground.

    Where axes move, displacements follow the bodies, as coordinates of their own: "sun.x" and
    "planet_1.xi" with r = 1, "planet_1.eta" with the radius of the planet centres, about which it
    turns with the carrier. Where they tilt, axial displacements and tilts follow: "sun.z" and
    "sun.wx", "planet_1.w_eta", tilts times the radius of `planar_radii`. Those that cannot change
    are the ground.
    """

    names: tuple[str, ...]  # without the ground, and of planets with the same motion only the first
    place: dict[str, int]  # index of every body; a held body is the ground
    copies: np.ndarray  # number of bodies with this motion
    mass: np.ndarray  # J/r^2 of one body [kg]
    radius: np.ndarray  # r of x = r theta [m]
    ratio: np.ndarray  # (bodies, AXES) rigid speed per speed of each input [-]

    @property
    def ground(self) -> int:
        """Index of the ground."""
        return len(self.names)


def build_bodies(layout: Layout) -> Bodies:
    """Collect masses, radii and speed ratios."""
    masses, radii, ratios = dict(layout.masses), dict(layout.radii), dict(layout.ratios)
    for name, machine in layout.machines.items():
        radii[name] = radii[machine.member]
        masses[name] = machine.inertia / radii[name] ** 2
    names = _order(layout)
    kinds = [_kind(name) for name in names]
    for kind, mass in _displaced(layout):
        masses[kind] = mass
        across = kind == "planet.eta"
        radii[kind] = layout.scene.gearset.geometry.centre_distance if across else 1.0
        ratios[kind] = tuple(ratio if across else Fraction(0) for ratio in ratios["carrier"])
    sizes = dict(zip(layout.leaders, layout.groups.sizes, strict=True))
    copies = np.array([*(sizes.get(name.split(".")[0], 1) for name in names), 1])
    ratio = np.zeros((len(kinds) + 1, AXES))
    axes = len(ratios["motor"])
    ratio[:-1, :axes] = [[float(r) for r in ratios[kind]] for kind in kinds]
    return Bodies(
        names,
        _places(layout, names),
        copies,
        np.array([masses[kind] for kind in kinds] + [1.0]),
        np.array([radii[kind] for kind in kinds] + [1.0]),
        ratio,
    )


def body_names(layout: Layout, bodies: Bodies) -> BodyNames:
    """Names and indices of the bodies that a result reports."""
    names = ("sun", *layout.planets, "ring", "carrier")
    index = np.array([bodies.place[name] for name in names])
    return BodyNames(names, index, tuple(layout.ratios[_kind(name)] for name in names))


def mesh_names(layout: Layout) -> MeshNames:
    """Names and indices of the meshes that a result reports."""
    groups, numbers = layout.groups, range(1, len(layout.planets) + 1)
    names = (*(f"sun_planet_{i}" for i in numbers), *(f"planet_ring_{i}" for i in numbers))
    place = np.array(groups.group)
    places = np.concatenate([place, place + len(groups.leaders)])
    torque = layout.scene.operating_point.input_torque
    if layout.scene.moving_axes and layout.mesh_force(torque) < 0.0:
        places += 2 * len(groups.leaders)  # the coast flanks, which have entries of their own
    return MeshNames(names, places)


def build_report(layout: Layout, names: BodyNames, meshes: MeshNames) -> Report:
    """What the core reports of a train: all bodies and meshes, in the order of their names."""
    common = [math.lcm(*(ratio.denominator for ratio in ratios)) for ratios in names.ratio]
    whole = zip(names.ratio, common, strict=True)
    report: Report = library(layout.scene).Report(
        bodies=len(names.names),
        body=names.place,
        numerator=[[int(ratio * n) for ratio in ratios] for ratios, n in whole],
        denominator=common,
        meshes=len(meshes.names),
        mesh=meshes.place,
    )
    return report


def _kind(name: str) -> str:
    body, *motion = name.split(".")
    return ".".join(["planet" if body.startswith("planet_") else body, *motion])


def _displaced(layout: Layout) -> list[tuple[str, float]]:
    """Kinds of displacements, "sun.x" for instance, and their masses [kg]."""
    scene = layout.scene
    supports = scene.supports if scene.moving_axes else None
    if supports is None:
        return []
    tilts = layout.tilting_masses if scene.tilting_axes else {}
    return [
        (f"{kind}.{motion}", tilts[kind] if "w" in motion else getattr(supports, kind).mass)
        for kind in (*CENTRAL, "planet")
        for motion in _motions(layout, kind)
    ]


def _motions(layout: Layout, body: str) -> tuple[str, ...]:
    """Names of the motions of an axis."""
    plane = in_plane(body)
    return (*plane, "z", *tilts_of(body)) if layout.scene.tilting_axes else plane


def in_plane(body: str) -> tuple[str, str]:
    """Names of the displacements of an axis in the plane."""
    return ("x", "y") if body in CENTRAL else ("xi", "eta")


def tilts_of(body: str) -> tuple[str, str]:
    """Names of the tilts of an axis, about the directions of its displacements in the plane."""
    return ("wx", "wy") if body in CENTRAL else ("w_xi", "w_eta")


def _displacements(layout: Layout) -> list[str]:
    """Names of the displacements that can change, see `planet_groups`.

    Spur teeth excite no axial motion and no tilts: these stay exactly zero, as ground.
    """
    if not layout.scene.moving_axes:
        return []
    stand, helical = layout.axes_stand, layout.scene.gearset.helix_angle != 0.0
    return [
        f"{body}.{motion}"
        for body in (*CENTRAL, *layout.leaders)
        for motion in (_motions(layout, body) if helical else in_plane(body))
        if motion == "z" or not (stand and body in CENTRAL)
    ]


def _order(layout: Layout) -> tuple[str, ...]:
    """Bodies that can turn, then displacements of axes."""
    free = [member for member in CENTRAL if member != layout.scene.gearset.held]
    return (*layout.leaders, *free, *layout.machines, *_displacements(layout))


def _places(layout: Layout, order: tuple[str, ...]) -> dict[str, int]:
    planets, groups = layout.planets, layout.groups
    leaders = (layout.leaders[group] for group in groups.group)
    leader = dict(zip(planets, leaders, strict=True))
    place = {name: n for n, name in enumerate(order)}

    def integrated(name: str) -> str:
        body, *motion = name.split(".")
        return ".".join([leader.get(body, body), *motion])

    every = ["sun", *planets, "ring", "carrier", *layout.machines]
    if layout.scene.moving_axes:
        every += [
            f"{body}.{motion}" for body in layout.bearings for motion in _motions(layout, body)
        ]
    return {name: place.get(integrated(name), len(order)) for name in every}
