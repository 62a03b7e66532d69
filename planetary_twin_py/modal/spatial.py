"""The three-dimensional model, 6 (N + 3) motions, for spur and helical gears (after Kahraman 1994).

What eqs. (20)-(31) of Salagianni et al. 2017 set up: every body moves by x, y, z, tilts by w_x and
w_y and turns by u, arc lengths at its base radius (that of the planet centres for the carrier). The
stretch of a spring is taken from the velocities of the two bodies at the point where they touch, so
moving or turning the unsupported whole stores nothing, whatever the helix. No gyroscopic terms.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .springs import Rows, Spring, SpringModel

Vector = np.ndarray
MOTIONS = ("x", "y", "z", "wx", "wy", "u")
CENTRAL = ("sun", "ring", "carrier")


@dataclass(frozen=True)
class SpatialBody:
    """A body of mass `mass` [kg], base radius `radius` [m], and its springs to where it is held.

    `rim_mass` is J/r^2, `tilt_mass` I/r^2 with the diametral inertia [kg]. Stiffnesses of the
    bearing across and along the axis, against tilting (moment/angle/r^2) and against turning [N/m];
    those of a planet act between it and the carrier.
    """

    mass: float
    rim_mass: float
    tilt_mass: float
    radius: float
    bearing: float
    axial: float
    tilting: float
    torsion: float = 0.0


@dataclass(frozen=True)
class SpatialSet:
    """A planetary gearset in space.

    Angles [rad]: of the planets, of pressure in the transverse plane, and the helix on the base
    circle, positive for a right-hand sun. Stiffness of a mesh is along its transverse line of
    action.
    """

    sun: SpatialBody
    ring: SpatialBody
    carrier: SpatialBody
    planet: SpatialBody
    planet_angles: tuple[float, ...]
    sun_planet: float
    planet_ring: float
    pressure_angle: float
    base_helix: float = 0.0


def spatial_model(data: SpatialSet) -> SpringModel:
    """All springs of a gearset in space."""
    planets = [f"planet_{i + 1}" for i in range(len(data.planet_angles))]
    names = [*CENTRAL, *planets]
    coordinates = tuple(f"{body}.{motion}" for body in names for motion in MOTIONS)
    row, springs, masses = Rows(coordinates), [], []
    for name in names:
        body = _body(data, name)
        masses += [body.mass] * 3 + [body.tilt_mass] * 2 + [body.rim_mass]
        if name in CENTRAL:
            springs += _supports(body, name, row)
    for planet, psi in zip(planets, data.planet_angles, strict=True):
        springs += _meshes(data, row, planet, psi) + _pin(data, row, planet, psi)
    return SpringModel(coordinates, np.array(masses), tuple(springs))


def _body(data: SpatialSet, name: str) -> SpatialBody:
    body: SpatialBody = getattr(data, name if name in CENTRAL else "planet")
    return body


def _supports(body: SpatialBody, name: str, row: Rows) -> list[Spring]:
    kinds = ("bearing", "bearing", "axial", "tilting", "tilting", "torsion")
    return [
        Spring(f"{name}_{kind}", getattr(body, kind), row({f"{name}.{motion}": 1.0}))
        for motion, kind in zip(MOTIONS, kinds, strict=True)
    ]


def _velocity(data: SpatialSet, name: str, direction: Vector, arm: Vector) -> dict[str, float]:
    """Entries for the motion along `direction` of the point of a body at `arm` from its centre."""
    turning = np.cross(arm, direction) / _body(data, name).radius
    return dict(zip((f"{name}.{m}" for m in MOTIONS), [*direction, *turning], strict=True))


def _relative(first: dict[str, float], second: dict[str, float]) -> dict[str, float]:
    return first | {name: -value for name, value in second.items()}


def _meshes(data: SpatialSet, row: Rows, planet: str, psi: float) -> list[Spring]:
    """Contact normals at the pitch points; a planet's screw motion disturbs neither mesh."""
    cosine, radial = math.cos(data.pressure_angle), np.array([math.cos(psi), math.sin(psi), 0.0])
    springs = []
    for gear, lean, hand in (("sun", -1.0, 1.0), ("ring", 1.0, -1.0)):
        turned, helix = psi + lean * data.pressure_angle, hand * data.base_helix
        flat = np.array([-math.sin(turned), math.cos(turned), 0.0])
        normal = math.cos(helix) * flat + math.sin(helix) * np.array([0.0, 0.0, 1.0])
        central = radial * _body(data, gear).radius / cosine
        outward = radial * lean * data.planet.radius / cosine
        parts = _relative(
            _velocity(data, gear, normal, central), _velocity(data, planet, normal, outward)
        )
        kind = "sun_planet" if gear == "sun" else "planet_ring"
        stiffness = getattr(data, kind) / math.cos(data.base_helix) ** 2
        springs.append(Spring(kind, stiffness, row(parts)))
    return springs


def _pin(data: SpatialSet, row: Rows, planet: str, psi: float) -> list[Spring]:
    """Bearing of a planet on its pin: three directions, and tilting with the carrier."""
    arm = data.carrier.radius * np.array([math.cos(psi), math.sin(psi), 0.0])
    body, springs = data.planet, []
    for direction, kind in zip(np.eye(3), ("bearing", "bearing", "axial"), strict=True):
        carried = _velocity(data, "carrier", direction, arm)
        parts = _relative(_velocity(data, planet, direction, np.zeros(3)), carried)
        springs.append(Spring(f"planet_{kind}", getattr(body, kind), row(parts)))
    share = body.radius / data.carrier.radius
    for motion in ("wx", "wy"):
        parts = {f"{planet}.{motion}": 1.0, f"carrier.{motion}": -share}
        springs.append(Spring("planet_tilting", body.tilting, row(parts)))
    return springs
