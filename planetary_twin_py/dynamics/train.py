"""The gearbox as arrays: bodies, meshes, couplings, as the compiled equations read them.

Coordinates. Every body has x = r theta, r its base radius (r_c cos(phi) for the carrier; that of
its member for a machine), measured in a frame that turns with the rigid train at the speed of the
motor. A mesh's transmission error is then a sum of three x with signs: d = x_s + x_p - x_c at the
sun, d = -x_p + x_r - x_c at the ring (al-Shyyab and Kahraman 2007, in base-circle coordinates).
A held body is the ground: one more entry whose x is zero.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from .._records import BODIES, FLAG, MESHES, REAL, WHOLE, Record, layout, new_record
from ..gearset.geometry import base_pitch, pitch_radius, planet_ring_path, sun_planet_path
from ..gearset.kinematics import mesh_cycles_per_turn, speed_ratios
from ..gearset.phasing import mesh_phases
from ..mesh.tooth_pairs import PAIRS, SEGMENTS, pair_table
from ..scene import Scene
from ..scene.drive import Machine

# Constant data of the gearbox. `bodies` of them can turn; entry `bodies` is the ground.
# Order of the bodies: planets, then what is free of sun, ring, carrier, then motor, load.
# Order of the meshes: sun meshes of all planets, then their ring meshes. Arrays with a first
# length of 2 hold the sun-planet mesh at 0 and the planet-ring mesh at 1.
TRAIN = layout(
    bodies=WHOLE,
    meshes=WHOLE,
    mass=(REAL, (BODIES,)),  # J/r^2 [kg]
    radius=(REAL, (BODIES,)),  # r of x = r theta [m]
    ratio=(REAL, (BODIES,)),  # rigid speed per speed of the motor [-]
    body=(WHOLE, (MESHES, 3)),  # first gear, second gear, carrier
    sign=(REAL, (MESHES, 3)),  # of their x in d
    kind=(WHOLE, (MESHES,)),
    phase=(REAL, (MESHES,)),  # delay in mesh cycles
    stiffness=(REAL, (2,)),  # of one tooth pair [N/m]
    pair_gain=REAL,  # growth of the stiffness with each further pair [-]
    damping_time=(REAL, (2,)),  # tau of c = tau k [s]; 0: by the meshing frequency
    damping_cycles=REAL,  # tau times meshing frequency [-]
    lowest_frequency=REAL,  # [Hz]
    base_pitch=REAL,  # [m]
    pitch_curvature=(REAL, (2, 2)),  # radii of curvature at the pitch point, both gears [m]
    external=(REAL, (2,)),  # +1: external, -1: internal
    segments=(WHOLE, (2,)),  # number of segments in a mesh cycle
    edge=(REAL, (2, SEGMENTS + 1)),
    shift=(REAL, (2, SEGMENTS, PAIRS)),
    offset=(REAL, (2, SEGMENTS, PAIRS)),
    slope=(REAL, (2, SEGMENTS, PAIRS)),
    coupling=(WHOLE, (2, 2)),  # machine and member: input, output
    coupling_stiffness=(REAL, (2,)),  # in coordinates x [N/m]
    coupling_damping=(REAL, (2,)),  # in coordinates x [N s/m]
    cycles=REAL,  # mesh cycles per turn of the motor, signed
    cycles_numerator=WHOLE,  # the same as a fraction
    cycles_denominator=WHOLE,
    sun=WHOLE,  # body or ground
    carrier=WHOLE,
    sun_advance=REAL,  # mesh cycles per x of the sun [1/m]
    carrier_advance=REAL,  # and per x of the carrier
    friction=FLAG,
)


class BodyNames(NamedTuple):
    """How the bodies that are reported map to the bodies that are integrated."""

    names: tuple[str, ...]  # ("sun", "planet_1", ..., "ring", "carrier")
    place: np.ndarray  # (bodies,) in the arrays of `TRAIN`
    ratio: tuple[Fraction, ...]  # rigid speed per speed of the motor


def rim_masses(scene: Scene) -> dict[str, float]:
    """J/r^2 [kg] of each kind of body, with the r of `TRAIN.radius`."""
    gearset = scene.gearset
    mass = gearset.equivalent_mass
    slant = 1.0 / math.cos(gearset.pressure_angle) ** 2  # (pitch radius/base radius)^2
    # The planets ride on the carrier: their mass turns with it.
    carried = mass.carrier + gearset.planets * gearset.planet_mass
    return {
        "sun": mass.sun * slant,
        "planet": mass.planet * slant,
        "ring": mass.ring * slant,
        "carrier": carried * slant,
    }


def base_radii(scene: Scene) -> dict[str, float]:
    """r [m] of x = r theta for each kind of body."""
    teeth, module = scene.gearset.tooth_numbers, scene.gearset.module
    cosine = math.cos(scene.gearset.pressure_angle)
    return {
        "sun": pitch_radius(teeth.sun, module) * cosine,
        "planet": pitch_radius(teeth.planet, module) * cosine,
        "ring": pitch_radius(teeth.ring, module) * cosine,
        "carrier": pitch_radius(teeth.sun + teeth.planet, module) * cosine,
    }


def body_names(scene: Scene) -> BodyNames:
    """Names and places of the bodies a result reports."""
    planets = [f"planet_{i + 1}" for i in range(scene.gearset.planets)]
    names = ("sun", *planets, "ring", "carrier")
    order = _order(scene)
    ratios = _ratios(scene)
    kinds = ["planet" if name in planets else name for name in names]
    index = [order.index(name) if name in order else len(order) for name in names]
    return BodyNames(names, np.array(index), tuple(ratios[kind] for kind in kinds))


def mesh_names(scene: Scene) -> tuple[str, ...]:
    """("sun_planet_1", ..., "planet_ring_1", ...)."""
    numbers = range(1, scene.gearset.planets + 1)
    return tuple(f"sun_planet_{i}" for i in numbers) + tuple(f"planet_ring_{i}" for i in numbers)


def _order(scene: Scene) -> list[str]:
    """Bodies that can turn, in the order of `TRAIN`."""
    planets = [f"planet_{i + 1}" for i in range(scene.gearset.planets)]
    free = [member for member in ("sun", "ring", "carrier") if member != scene.gearset.held]
    return [*planets, *free, "motor", "load"]


def _ratios(scene: Scene) -> dict[str, Fraction]:
    gearset, drive = scene.gearset, scene.drive
    ratios = speed_ratios(gearset.tooth_numbers, gearset.held, drive.input.member)
    return {**ratios, "motor": Fraction(1), "load": ratios[drive.output.member]}


def build_train(scene: Scene) -> Record:
    """Translate a scene into arrays.

    Raises:
        ValueError: the teeth leave a moment without contact (see `pair_table`).
    """
    gearset, mesh = scene.gearset, scene.mesh
    order = _order(scene)
    ground = len(order)
    place = {name: order.index(name) if name in order else ground for name in _all_bodies(scene)}
    mass, radius, ratio = _body_arrays(scene, order)
    body, sign = _mesh_rows(gearset.planets, place)
    teeth, angle = gearset.tooth_numbers, gearset.pressure_angle
    tables = [
        pair_table(path(teeth, angle, gearset.addendum), mesh.ramp)
        for path in (sun_planet_path, planet_ring_path)
    ]
    sun_phase, ring_phase = mesh_phases(teeth, gearset.planet_angles)
    sine, pitch = math.sin(angle), base_pitch(gearset.module, angle)
    curvature = {n: pitch_radius(z, gearset.module) * sine for n, z in teeth._asdict().items()}
    cycles = mesh_cycles_per_turn(teeth, gearset.held, scene.drive.input.member)
    machines = (("motor", scene.drive.input), ("load", scene.drive.output))
    stiffness = np.array([mesh.sun_planet_stiffness, mesh.planet_ring_stiffness])
    by_frequency = mesh.damping.law == "meshing_frequency"
    return new_record(
        TRAIN,
        bodies=ground,
        meshes=2 * gearset.planets,
        mass=mass,
        radius=radius,
        ratio=ratio,
        body=body,
        sign=sign,
        kind=np.repeat([0, 1], gearset.planets),
        phase=np.array(sun_phase + ring_phase),
        stiffness=stiffness,
        pair_gain=mesh.double_pair_ratio - 1.0,
        damping_time=np.zeros(2) if by_frequency else _viscous_times(scene, stiffness),
        damping_cycles=mesh.damping.loss_factor if by_frequency else 0.0,
        lowest_frequency=mesh.damping.lowest_frequency,
        base_pitch=pitch,
        pitch_curvature=np.array(
            [[curvature["sun"], curvature["planet"]], [curvature["planet"], curvature["ring"]]]
        ),
        external=np.array([1.0, -1.0]),
        segments=np.array([table.segments for table in tables]),
        edge=np.array([table.edge for table in tables]),
        shift=np.array([table.shift for table in tables]),
        offset=np.array([table.offset for table in tables]),
        slope=np.array([table.slope for table in tables]),
        coupling=np.array([[place[machine], place[m.member]] for machine, m in machines]),
        coupling_stiffness=np.array([_scaled(m, "stiffness", scene) for _, m in machines]),
        coupling_damping=np.array([_scaled(m, "damping", scene) for _, m in machines]),
        cycles=float(cycles),
        cycles_numerator=cycles.numerator,
        cycles_denominator=cycles.denominator,
        sun=place["sun"],
        carrier=place["carrier"],
        sun_advance=1.0 / pitch,
        carrier_advance=-base_radii(scene)["sun"] / base_radii(scene)["carrier"] / pitch,
        friction=scene.lubrication.friction,
    )


def _all_bodies(scene: Scene) -> list[str]:
    planets = [f"planet_{i + 1}" for i in range(scene.gearset.planets)]
    return ["sun", *planets, "ring", "carrier", "motor", "load"]


def _body_arrays(scene: Scene, order: list[str]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """J/r^2, r and rigid speed ratio of every body and of the ground."""
    masses, radii, ratios = rim_masses(scene), base_radii(scene), _ratios(scene)
    for name, machine in (("motor", scene.drive.input), ("load", scene.drive.output)):
        radii[name] = radii[machine.member]
        masses[name] = machine.inertia / radii[name] ** 2
    kinds = ["planet" if name.startswith("planet_") else name for name in order]
    mass = np.array([masses[kind] for kind in kinds] + [1.0])
    radius = np.array([radii[kind] for kind in kinds] + [1.0])
    ratio = np.array([float(ratios[kind]) for kind in kinds] + [0.0])
    return mass, radius, ratio


def _mesh_rows(planets: int, place: dict[str, int]) -> tuple[np.ndarray, np.ndarray]:
    """Bodies of each mesh and the signs of their x in its transmission error."""
    numbers = range(1, planets + 1)
    sun = [[place["sun"], place[f"planet_{i}"], place["carrier"]] for i in numbers]
    ring = [[place[f"planet_{i}"], place["ring"], place["carrier"]] for i in numbers]
    signs = [[1.0, 1.0, -1.0]] * planets + [[-1.0, 1.0, -1.0]] * planets
    return np.array(sun + ring), np.array(signs)


def _viscous_times(scene: Scene, stiffness: np.ndarray) -> np.ndarray:
    """tau = 2 zeta/omega of each kind of mesh on its own two gears, at single-pair stiffness."""
    mass = rim_masses(scene)
    pairs = (("sun", "planet"), ("planet", "ring"))
    effective = [mass[a] * mass[b] / (mass[a] + mass[b]) for a, b in pairs]
    return 2.0 * scene.mesh.damping.damping_ratio * np.sqrt(np.array(effective) / stiffness)


def _scaled(machine: Machine, which: str, scene: Scene) -> float:
    """Stiffness or damping of a coupling in coordinates x = r theta."""
    value: float = getattr(machine, f"coupling_{which}")
    return value / base_radii(scene)[machine.member] ** 2
