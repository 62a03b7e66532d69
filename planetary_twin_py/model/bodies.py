"""The bodies of a scene: names, inertias, radii and speed ratios."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from types import ModuleType
from typing import NamedTuple

import numpy as np

from .._core import AXES, Report
from ..gearset.kinematics import speeds_per_input
from ..scene import OperatingPoint, Scene
from ..scene.drive import Machine
from .planet_groups import axes_stand, planet_groups

# Indices of the machines. The motor of input 0 is machine 0, the motor of input 1 is machine 2.
MOTOR, LOAD_MACHINE, SECOND_MOTOR = 0, 1, 2
MACHINE_NAMES = ("motor", "load", "second_motor")
CENTRAL = ("sun", "ring", "carrier")

Ratios = tuple[Fraction, ...]  # speed per speed of each input


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
    """Arrays over the bodies that can turn; the last entry is the ground.

    Where axes move, displacements follow the bodies, as coordinates of their own: "sun.x" and
    "planet_1.xi" with r = 1, "planet_1.eta" with the radius of the planet centres, about which it
    turns with the carrier. Where they tilt, axial displacements and tilts follow: "sun.z" and
    "sun.wx", "planet_1.w_eta", tilts times the radius of `tilting_radii`. Those that cannot change
    are the ground.
    """

    place: dict[str, int]  # index of every body; a held body is the ground
    copies: np.ndarray  # number of bodies with this motion
    mass: np.ndarray  # J/r^2 of one body [kg]
    radius: np.ndarray  # r of x = r theta [m]
    ratio: np.ndarray  # (bodies, AXES) rigid speed per speed of each input [-]


def rim_masses(scene: Scene) -> dict[str, float]:
    """J/r^2 [kg] of each kind of body, with the r of `base_radii`."""
    gearset = scene.gearset
    mass = gearset.rim_masses
    slant = 1.0 / math.cos(gearset.transverse.pressure_angle) ** 2  # (pitch radius/base radius)^2
    # The mass of the planets turns with the carrier, unless they move on it.
    carried = mass.carrier
    if not scene.moving_axes:
        carried += gearset.planets * gearset.planet_mass
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
    """Motors and load by name, in the order of their indices."""
    motor, *second = scene.drive.inputs
    return dict(zip(MACHINE_NAMES, (motor, scene.drive.output, *second), strict=False))


def rigid_ratios(scene: Scene) -> dict[str, Ratios]:
    """Speeds of every kind of body per speed of each input."""
    gearset = scene.gearset
    members = [machine.member for machine in scene.drive.inputs]
    axes = speeds_per_input(gearset.tooth_numbers, members, gearset.held)
    ratios = {kind: tuple(axis[kind] for axis in axes) for kind in axes[0]}
    return ratios | {name: ratios[machine.member] for name, machine in machines(scene).items()}


def rigid_speeds(scene: Scene, inputs: Sequence[float]) -> dict[str, float]:
    """Speed [rad/s] of every kind of body, for speeds [rad/s] of the motors; a missing one is 0."""
    return {
        kind: sum(float(ratio) * speed for ratio, speed in zip(ratios, inputs, strict=False))
        for kind, ratios in rigid_ratios(scene).items()
    }


def carrier_speed(scene: Scene, point: OperatingPoint) -> float:
    """Speed of the carrier [rad/s] at an operating point."""
    return rigid_speeds(scene, (point.input_speed, point.second_input_speed))["carrier"]


def body_names(scene: Scene) -> BodyNames:
    """Names and indices of the bodies that a result reports."""
    names = ("sun", *_planets(scene), "ring", "carrier")
    place, ratios = _places(scene), rigid_ratios(scene)
    index = np.array([place[name] for name in names])
    return BodyNames(names, index, tuple(ratios[_kind(name)] for name in names))


def mesh_names(scene: Scene) -> MeshNames:
    """Names and indices of the meshes that a result reports."""
    numbers, groups = range(1, scene.gearset.planets + 1), planet_groups(scene)
    names = (*(f"sun_planet_{i}" for i in numbers), *(f"planet_ring_{i}" for i in numbers))
    place = np.array(groups.group)
    places = np.concatenate([place, place + len(groups.leaders)])
    if scene.moving_axes and _coasts(scene):
        places += 2 * len(groups.leaders)  # the coast flanks, which have entries of their own
    return MeshNames(names, places)


def _coasts(scene: Scene) -> bool:
    """Whether the torque of the operating point loads the coast flanks."""
    against = -1.0 if scene.drive.input.member == "carrier" else 1.0
    return against * scene.operating_point.input_torque < 0.0


def build_report(core: ModuleType, names: BodyNames, meshes: MeshNames) -> Report:
    """What the core reports of a train: all bodies and meshes, in the order of their names.

    `core` is that of the scene, see `library`.
    """
    common = [math.lcm(*(ratio.denominator for ratio in ratios)) for ratios in names.ratio]
    whole = zip(names.ratio, common, strict=True)
    report: Report = core.Report(
        bodies=len(names.names),
        body=names.place,
        numerator=[[int(ratio * n) for ratio in ratios] for ratios, n in whole],
        denominator=common,
        meshes=len(meshes.names),
        mesh=meshes.place,
    )
    return report


def build_bodies(scene: Scene) -> Bodies:
    """Collect masses, radii and speed ratios."""
    masses, radii, ratios = rim_masses(scene), base_radii(scene), rigid_ratios(scene)
    for name, machine in machines(scene).items():
        radii[name] = radii[machine.member]
        masses[name] = machine.inertia / radii[name] ** 2
    order = _order(scene)
    kinds = [_kind(name) for name in order]
    for kind, mass in _displaced(scene):
        masses[kind] = mass
        across = kind == "planet.eta"
        radii[kind] = scene.gearset.geometry.centre_distance if across else 1.0
        ratios[kind] = tuple(ratio if across else Fraction(0) for ratio in ratios["carrier"])
    sizes = {_planets(scene)[i]: n for i, n in zip(*planet_groups(scene)[:2], strict=True)}
    copies = np.array([*(sizes.get(name.split(".")[0], 1) for name in order), 1])
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
    body, *motion = name.split(".")
    return ".".join(["planet" if body.startswith("planet_") else body, *motion])


def _displaced(scene: Scene) -> list[tuple[str, float]]:
    """Kinds of displacements, "sun.x" for instance, and their masses [kg]."""
    supports = scene.supports if scene.moving_axes else None
    if supports is None:
        return []
    tilts = tilting_masses(scene) if scene.tilting_axes else {}
    return [
        (f"{kind}.{motion}", tilts[kind] if "w" in motion else getattr(supports, kind).mass)
        for kind in (*CENTRAL, "planet")
        for motion in _motions(scene, kind)
    ]


def _motions(scene: Scene, body: str) -> tuple[str, ...]:
    """Names of the motions of an axis."""
    plane = in_plane(body)
    return (*plane, "z", *tilts_of(body)) if scene.tilting_axes else plane


def in_plane(body: str) -> tuple[str, str]:
    """Names of the displacements of an axis in the plane."""
    return ("x", "y") if body in CENTRAL else ("xi", "eta")


def tilts_of(body: str) -> tuple[str, str]:
    """Names of the tilts of an axis, about the directions of its displacements in the plane."""
    return ("wx", "wy") if body in CENTRAL else ("w_xi", "w_eta")


def tilting_radii(scene: Scene) -> dict[str, float]:
    """Radius [m] of each kind of body at which tilts are ways, as in `scene.supports`."""
    gears = scene.gearset.geometry
    return base_radii(scene) | {"carrier": gears.centre_distance}


def polar_masses(scene: Scene) -> dict[str, float]:
    """J/r^2 [kg] of each kind of body with that radius; the carrier without planets."""
    found = rim_masses(scene)
    return found | {"carrier": scene.gearset.rim_masses.carrier}


def tilting_masses(scene: Scene) -> dict[str, float]:
    """I/r^2 [kg] of each kind of body with the diametral inertia I."""
    polar = polar_masses(scene)
    return {
        kind: getattr(scene.supports, kind).diametral(polar[kind]) for kind in (*CENTRAL, "planet")
    }


def _displacements(scene: Scene) -> list[str]:
    """Names of the displacements that can change, see `planet_groups`.

    Spur teeth excite no axial motion and no tilts: these stay exactly zero, as ground.
    """
    if not scene.moving_axes:
        return []
    stand, helical = axes_stand(scene), scene.gearset.helix_angle != 0.0
    leaders = [_planets(scene)[leader] for leader in planet_groups(scene).leaders]
    return [
        f"{body}.{motion}"
        for body in (*CENTRAL, *leaders)
        for motion in (_motions(scene, body) if helical else in_plane(body))
        if motion == "z" or not (stand and body in CENTRAL)
    ]


def _order(scene: Scene) -> list[str]:
    """Bodies that can turn: planets, then members that are not held, then machines.

    Of planets with the same motion, only the first is listed. Displacements of axes follow.
    """
    free = [member for member in ("sun", "ring", "carrier") if member != scene.gearset.held]
    planets = [_planets(scene)[leader] for leader in planet_groups(scene).leaders]
    return [*planets, *free, *machines(scene), *_displacements(scene)]


def _places(scene: Scene) -> dict[str, int]:
    order, planets, groups = _order(scene), _planets(scene), planet_groups(scene)
    leaders = (planets[groups.leaders[group]] for group in groups.group)
    leader = dict(zip(planets, leaders, strict=True))
    place = {name: n for n, name in enumerate(order)}

    def integrated(name: str) -> str:
        body, *motion = name.split(".")
        return ".".join([leader.get(body, body), *motion])

    every = ["sun", *planets, "ring", "carrier", *machines(scene)]
    if scene.moving_axes:
        every += [
            f"{body}.{motion}" for body in (*CENTRAL, *planets) for motion in _motions(scene, body)
        ]
    return {name: place.get(integrated(name), len(order)) for name in every}
