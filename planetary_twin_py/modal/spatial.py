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

import numpy as np

from ..model.planar_rows import CENTRAL
from .springs import Rows, Spring, SpringModel
from .supported_set import Body, SupportedSet

Vector = np.ndarray
MOTIONS = ("x", "y", "z", "wx", "wy", "u")


def spatial_model(data: SupportedSet) -> SpringModel:
    """Spring model of a gearset in space.

    Args:
        data: bodies and stiffnesses of the gearset.

    Returns:
        Masses and springs over 6 (N + 3) coordinates.
    """
    names = [*CENTRAL, *data.planets]
    coordinates = tuple(f"{body}.{motion}" for body in names for motion in MOTIONS)
    row, springs, masses = Rows(coordinates), [], []
    for name in names:
        body = data.body(name)
        masses += [body.mass] * 3 + [body.tilt_mass] * 2 + [body.rim_mass]
        if name in CENTRAL:
            springs += _supports(body, name, row)
    planets = zip(data.planets, data.planet_angles, *data.factors, strict=True)
    for planet, psi, mesh, pin in planets:
        springs += _meshes(data, row, planet, psi, mesh) + _pin(data, row, planet, psi, pin)
    return SpringModel(coordinates, np.array(masses), tuple(springs))


def _supports(body: Body, name: str, row: Rows) -> list[Spring]:
    kinds = ("bearing", "bearing", "axial", "tilting", "tilting", "torsion")
    return [
        Spring(f"{name}_{kind}", getattr(body, kind), row({f"{name}.{motion}": 1.0}))
        for motion, kind in zip(MOTIONS, kinds, strict=True)
    ]


def _velocity(data: SupportedSet, name: str, direction: Vector, arm: Vector) -> dict[str, float]:
    """Row of the displacement along `direction` of the point at `arm` from the centre of a body."""
    turning = np.cross(arm, direction) / data.body(name).radius
    return dict(zip((f"{name}.{m}" for m in MOTIONS), [*direction, *turning], strict=True))


def _relative(first: dict[str, float], second: dict[str, float]) -> dict[str, float]:
    return first | {name: -value for name, value in second.items()}


def _meshes(
    data: SupportedSet, row: Rows, planet: str, psi: float, mesh_factor: float
) -> list[Spring]:
    """Springs along the contact normals at the pitch points, with a factor on their stiffness."""
    radial, springs = np.array([math.cos(psi), math.sin(psi), 0.0]), []
    for gear, lean, hand in (("sun", -1.0, 1.0), ("ring", 1.0, -1.0)):
        angle = data.sun_angle if gear == "sun" else data.ring_angle
        cosine, turned, helix = math.cos(angle), psi + lean * angle, hand * data.base_helix
        flat = np.array([-math.sin(turned), math.cos(turned), 0.0])
        normal = math.cos(helix) * flat + math.sin(helix) * np.array([0.0, 0.0, 1.0])
        central = radial * data.body(gear).radius / cosine
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


def _tilt(data: SupportedSet, name: str, direction: Vector) -> dict[str, float]:
    """Row of the tilt of a body about `direction`."""
    radius = data.body(name).radius
    return {f"{name}.{m}": part / radius for m, part in zip(("wx", "wy"), direction, strict=False)}


def _pin(data: SupportedSet, row: Rows, planet: str, psi: float, pin_factor: float) -> list[Spring]:
    """Springs of the bearing of a planet: three directions, and tilting relative to the carrier.

    Its radial stiffness is `pin_factor` times the nominal one.
    """
    outwards = np.array([math.cos(psi), math.sin(psi), 0.0])
    sideways = np.array([-math.sin(psi), math.cos(psi), 0.0])
    arm = data.carrier.radius * outwards
    body, springs = data.planet, []
    for direction, kind, stiffness, factor in (
        (outwards, "bearing", body.bearing, pin_factor),
        (sideways, "bearing", body.sideways, pin_factor),
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
