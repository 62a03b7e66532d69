"""The bodies of a scene: which there are, how heavy, and how fast they turn together."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from .._core import AXES
from ..gearset.kinematics import speeds_per_input
from ..scene import Scene
from ..scene.drive import Machine
from .alike import planet_groups

# Places of the machines. The motor of input 0 is machine 0, that of input 1 machine 2, if any.
MOTOR, LOAD_MACHINE, SECOND_MOTOR = 0, 1, 2
MACHINE_NAMES = ("motor", "load", "second_motor")

Ratios = tuple[Fraction, ...]  # speed per speed of each input


class BodyNames(NamedTuple):
    """How the bodies that are reported map to the bodies that are integrated."""

    names: tuple[str, ...]  # ("sun", "planet_1", ..., "ring", "carrier")
    place: np.ndarray  # (bodies,) in the arrays of `TRAIN`
    ratio: tuple[Ratios, ...]


class MeshNames(NamedTuple):
    """How the meshes that are reported map to the meshes that are integrated."""

    names: tuple[str, ...]  # ("sun_planet_1", ..., "planet_ring_1", ...)
    place: np.ndarray  # (meshes,) in the arrays of `TRAIN`


class Bodies(NamedTuple):
    """Arrays over the bodies that can turn, and the ground as the last entry."""

    place: dict[str, int]  # of every body; a held one is the ground
    copies: np.ndarray  # bodies that move alike, of which an entry is one
    mass: np.ndarray  # J/r^2 of one of them [kg]
    radius: np.ndarray  # r of x = r theta [m]
    ratio: np.ndarray  # (bodies, AXES) rigid speed per speed of each input [-]


def rim_masses(scene: Scene) -> dict[str, float]:
    """J/r^2 [kg] of each kind of body, with the r of `base_radii`."""
    gearset = scene.gearset
    mass = gearset.rim_masses
    slant = 1.0 / math.cos(gearset.pressure_angle) ** 2  # (pitch radius/base radius)^2
    # The planets ride on the carrier: their mass turns with it.
    carried = mass.carrier + gearset.planets * gearset.planet_mass
    turned = 1.0 / math.cos(gearset.geometry.meshes[0].pressure_angle) ** 2
    return {
        "sun": mass.sun * slant,
        "planet": mass.planet * slant,
        "ring": mass.ring * slant,
        "carrier": carried * turned,
    }


def base_radii(scene: Scene) -> dict[str, float]:
    """r [m] of x = r theta for each kind of body: base radii, r_c cos(phi) for the carrier.

    With the working pressure angle phi of the sun meshes, so it is r_bs + r_bp for the carrier.
    """
    gears = scene.gearset.geometry
    return {
        "sun": gears.sun.base_radius,
        "planet": gears.planet.base_radius,
        "ring": gears.ring.base_radius,
        "carrier": gears.centre_distance * math.cos(gears.meshes[0].pressure_angle),
    }


def machines(scene: Scene) -> dict[str, Machine]:
    """Motors and load by their names, in the order of their places."""
    motor, *second = scene.drive.inputs
    return dict(zip(MACHINE_NAMES, (motor, scene.drive.output, *second), strict=False))


def rigid_ratios(scene: Scene) -> dict[str, Ratios]:
    """Speeds of every kind of body per speed of each input."""
    gearset = scene.gearset
    members = [machine.member for machine in scene.drive.inputs]
    axes = speeds_per_input(gearset.tooth_numbers, members, gearset.held)
    ratios = {kind: tuple(axis[kind] for axis in axes) for kind in axes[0]}
    return ratios | {name: ratios[machine.member] for name, machine in machines(scene).items()}


def body_names(scene: Scene) -> BodyNames:
    """Names and places of the bodies a result reports."""
    names = ("sun", *_planets(scene), "ring", "carrier")
    place, ratios = _places(scene), rigid_ratios(scene)
    index = np.array([place[name] for name in names])
    return BodyNames(names, index, tuple(ratios[_kind(name)] for name in names))


def mesh_names(scene: Scene) -> MeshNames:
    """Names and places of the meshes a result reports."""
    numbers, groups = range(1, scene.gearset.planets + 1), planet_groups(scene)
    names = (*(f"sun_planet_{i}" for i in numbers), *(f"planet_ring_{i}" for i in numbers))
    place = np.array(groups.group)
    return MeshNames(names, np.concatenate([place, place + len(groups.leaders)]))


def build_bodies(scene: Scene) -> Bodies:
    """Collect masses, radii and speed ratios."""
    masses, radii, ratios = rim_masses(scene), base_radii(scene), rigid_ratios(scene)
    for name, machine in machines(scene).items():
        radii[name] = radii[machine.member]
        masses[name] = machine.inertia / radii[name] ** 2
    kinds = [_kind(name) for name in _order(scene)]
    sizes = planet_groups(scene).sizes
    copies = np.array([*sizes, *[1] * (len(kinds) + 1 - len(sizes))])
    ratio = np.zeros((len(kinds) + 1, AXES))
    axes = len(ratios["motor"])
    ratio[:-1, :axes] = [[float(r) for r in ratios[kind]] for kind in kinds]
    return Bodies(
        _places(scene),
        copies,
        np.array([masses[kind] for kind in kinds] + [1.0]),
        np.array([radii[kind] for kind in kinds] + [1.0]),
        ratio,
    )


def _planets(scene: Scene) -> list[str]:
    return [f"planet_{i + 1}" for i in range(scene.gearset.planets)]


def _kind(name: str) -> str:
    return "planet" if name.startswith("planet_") else name


def _order(scene: Scene) -> list[str]:
    """Bodies that can turn: planets, then what is free of the members, then the machines.

    Of planets that move alike, the first.
    """
    free = [member for member in ("sun", "ring", "carrier") if member != scene.gearset.held]
    planets = [_planets(scene)[leader] for leader in planet_groups(scene).leaders]
    return [*planets, *free, *machines(scene)]


def _places(scene: Scene) -> dict[str, int]:
    order = _order(scene)
    place = dict(zip(_planets(scene), planet_groups(scene).group, strict=True))
    place |= {name: n for n, name in enumerate(order) if name not in place}
    every = ["sun", *_planets(scene), "ring", "carrier", *machines(scene)]
    return {name: place.get(name, len(order)) for name in every}
