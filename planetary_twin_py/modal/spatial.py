"""Spatial model for spur and helical gears with 6 (N + 3) coordinates (after Kahraman 1994).

It is the model that eqs. (20)-(31) of Salagianni et al. 2017 intend. The coordinates of a body are
its displacements x, y and z, tilts w_x and w_y, and rotation u; the last three are arc lengths at
its base radius, for the carrier at the radius of the planet centres. The deformation of a spring
follows from the displacements of both bodies at their contact point, so a rigid motion of the
unsupported gearset deforms no spring at any helix angle. Beside its normal spring a mesh of
stiffness k and face width L has the energy k L^2 s^2/24 of the slope s of the flanks along the
face, with which the deflection of its parts differs. Gyroscopic terms are in `turning`.
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
    """A body of the spatial model; the bearing of a planet is on the carrier."""

    mass: float
    """[kg]"""
    rim_mass: float
    """J/r^2 with the polar inertia J [kg]."""
    tilt_mass: float
    """I/r^2 with the diametral inertia I [kg]."""
    radius: float
    """Base radius r, for the carrier the radius of the planet centres [m]."""
    bearing: float
    """Radial stiffness of the bearing [N/m]."""
    axial: float
    """Axial stiffness of the bearing [N/m]."""
    tilting: float
    """Tilting stiffness of the bearing, moment/angle/r^2 [N/m]."""
    torsion: float = 0.0
    """Stiffness of a torsional support, moment/angle/r^2 [N/m]."""
    across: float | None = None
    """Radial stiffness across the radius of a planet [N/m]; None: `bearing`."""


@dataclass(frozen=True)
class SpatialSet:
    """A planetary gearset in space."""

    sun: SpatialBody
    ring: SpatialBody
    carrier: SpatialBody
    planet: SpatialBody
    planet_angles: tuple[float, ...]
    """Positions of the planets [rad]."""
    sun_planet: float
    """Stiffness of a sun-planet mesh along its transverse line of action [N/m]."""
    planet_ring: float
    """Stiffness of a planet-ring mesh along its transverse line of action [N/m]."""
    pressure_angle: float
    """Working pressure angle of the sun-planet meshes in the transverse plane [rad]."""
    base_helix: float = 0.0
    """Helix angle on the base circle, positive for a right-hand sun [rad]."""
    ring_angle: float | None = None
    """Working pressure angle of the planet-ring meshes [rad]; default: that of the others."""
    face_width: float = 0.0
    """Face width, along which each mesh resists tilting [m]; 0: at one point."""
    mesh_factors: tuple[float, ...] = ()
    """Factors on the stiffness of both meshes of each planet, 0 if open, (planets,); default: 1."""
    pin_factors: tuple[float, ...] = ()
    """Factors on the radial stiffness of each planet's bearing, (planets,); default: 1."""


def spatial_model(data: SpatialSet) -> SpringModel:
    """Spring model of a gearset in space.

    Args:
        data: bodies and stiffnesses of the gearset.

    Returns:
        Masses and springs over 6 (N + 3) coordinates.
    """
    planets = [f"planet_{i + 1}" for i in range(len(data.planet_angles))]
    names = [*CENTRAL, *planets]
    coordinates = tuple(f"{body}.{motion}" for body in names for motion in MOTIONS)
    row, springs, masses = Rows(coordinates), [], []
    for name in names:
        body = _body(data, name)
        masses += [body.mass] * 3 + [body.tilt_mass] * 2 + [body.rim_mass]
        if name in CENTRAL:
            springs += _supports(body, name, row)
    meshes, pins = (
        factors or (1.0,) * len(planets) for factors in (data.mesh_factors, data.pin_factors)
    )
    for planet, psi, mesh, pin in zip(planets, data.planet_angles, meshes, pins, strict=True):
        springs += _meshes(data, row, planet, psi, mesh) + _pin(data, row, planet, psi, pin)
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
    """Row of the displacement along `direction` of the point at `arm` from the centre of a body."""
    turning = np.cross(arm, direction) / _body(data, name).radius
    return dict(zip((f"{name}.{m}" for m in MOTIONS), [*direction, *turning], strict=True))


def _relative(first: dict[str, float], second: dict[str, float]) -> dict[str, float]:
    return first | {name: -value for name, value in second.items()}


def _meshes(
    data: SpatialSet, row: Rows, planet: str, psi: float, mesh_factor: float
) -> list[Spring]:
    """Springs along the contact normals at the pitch points, with a factor on their stiffness."""
    radial, springs = np.array([math.cos(psi), math.sin(psi), 0.0]), []
    ring = data.pressure_angle if data.ring_angle is None else data.ring_angle
    for gear, lean, hand in (("sun", -1.0, 1.0), ("ring", 1.0, -1.0)):
        angle = data.pressure_angle if gear == "sun" else ring
        cosine, turned, helix = math.cos(angle), psi + lean * angle, hand * data.base_helix
        flat = np.array([-math.sin(turned), math.cos(turned), 0.0])
        normal = math.cos(helix) * flat + math.sin(helix) * np.array([0.0, 0.0, 1.0])
        central = radial * _body(data, gear).radius / cosine
        outward = radial * lean * data.planet.radius / cosine
        parts = _relative(
            _velocity(data, gear, normal, central), _velocity(data, planet, normal, outward)
        )
        kind = "sun_planet" if gear == "sun" else "planet_ring"
        stiffness = mesh_factor * getattr(data, kind) / math.cos(data.base_helix) ** 2
        springs.append(Spring(kind, stiffness, row(parts), mesh_factor))
        tilting = mesh_factor * getattr(data, kind) * data.face_width**2 / 12.0
        if tilting > 0.0:
            slope = np.cross([0.0, 0.0, 1.0], flat)
            parts = _relative(_tilt(data, gear, slope), _tilt(data, planet, slope))
            springs.append(Spring(f"{kind}_tilting", tilting, row(parts), mesh_factor))
    return springs


def _tilt(data: SpatialSet, name: str, direction: Vector) -> dict[str, float]:
    """Row of the tilt of a body about `direction`."""
    radius = _body(data, name).radius
    return {f"{name}.{m}": part / radius for m, part in zip(("wx", "wy"), direction, strict=False)}


def _pin(data: SpatialSet, row: Rows, planet: str, psi: float, pin_factor: float) -> list[Spring]:
    """Springs of the bearing of a planet: three directions, and tilting relative to the carrier.

    Its radial stiffness is `pin_factor` times the nominal one.
    """
    outwards = np.array([math.cos(psi), math.sin(psi), 0.0])
    sideways = np.array([-math.sin(psi), math.cos(psi), 0.0])
    arm = data.carrier.radius * outwards
    body, springs = data.planet, []
    across = body.bearing if body.across is None else body.across
    for direction, kind, stiffness, factor in (
        (outwards, "bearing", body.bearing, pin_factor),
        (sideways, "bearing", across, pin_factor),
        (np.array([0.0, 0.0, 1.0]), "axial", body.axial, 1.0),
    ):
        carried = _velocity(data, "carrier", direction, arm)
        parts = _relative(_velocity(data, planet, direction, np.zeros(3)), carried)
        springs.append(Spring(f"planet_{kind}", factor * stiffness, row(parts), factor))
    share = body.radius / data.carrier.radius
    for motion in ("wx", "wy"):
        parts = {f"{planet}.{motion}": 1.0, f"carrier.{motion}": -share}
        springs.append(Spring("planet_tilting", body.tilting, row(parts)))
    return springs
