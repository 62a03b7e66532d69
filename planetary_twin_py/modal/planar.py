"""Planar model of Lin and Parker 1999 (J. Vib. Acoust. 121, 316) with 3 (N + 3) coordinates.

Coordinates of sun, ring and carrier are x, y and u = r theta in the frame of the carrier. Those of
a planet are xi in the radial and eta in the tangential direction, and u. There are no gyroscopic
terms, as in (36) of Salagianni et al. 2017.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .springs import Rows, Spring, SpringModel


@dataclass(frozen=True)
class PlanarBody:
    """A body of the planar model."""

    mass: float
    """[kg]"""
    rim_mass: float
    """J/r^2 [kg]; r is the base radius, for the carrier the radius of the planet centres."""
    bearing: float
    """Radial stiffness of the bearing [N/m]; the bearing of a planet is on the carrier."""
    torsion: float = 0.0
    """Stiffness of a torsional support, divided by r^2 [N/m]."""


@dataclass(frozen=True)
class PlanarSet:
    """A planetary gearset in the plane."""

    sun: PlanarBody
    ring: PlanarBody
    carrier: PlanarBody
    planet: PlanarBody
    planet_angles: tuple[float, ...]
    """Positions of the planets [rad]."""
    sun_planet: float
    """Stiffness of a sun-planet mesh along the line of action [N/m]."""
    planet_ring: float
    """Stiffness of a planet-ring mesh along the line of action [N/m]."""
    sun_angle: float
    """Transverse pressure angle of the sun-planet meshes [rad]."""
    ring_angle: float
    """Transverse pressure angle of the planet-ring meshes [rad]."""

    @property
    def planets(self) -> tuple[str, ...]:
        """Names of the planets."""
        return tuple(f"planet_{i + 1}" for i in range(len(self.planet_angles)))


def planar_model(data: PlanarSet) -> SpringModel:
    """Spring model with the matrices of Lin and Parker 1999.

    Args:
        data: bodies and stiffnesses of the gearset.

    Returns:
        Masses and springs over 3 (N + 3) coordinates.
    """
    central = ("sun", "ring", "carrier")
    coordinates = tuple(f"{body}.{m}" for body in central for m in ("x", "y", "u"))
    coordinates += tuple(f"{body}.{m}" for body in data.planets for m in ("xi", "eta", "u"))
    row, springs = Rows(coordinates), []
    for body in central:
        values: PlanarBody = getattr(data, body)
        springs += [
            Spring(f"{body}_bearing", values.bearing, row({f"{body}.x": 1.0})),
            Spring(f"{body}_bearing", values.bearing, row({f"{body}.y": 1.0})),
            Spring(f"{body}_torsion", values.torsion, row({f"{body}.u": 1.0})),
        ]
    for planet, psi in zip(data.planets, data.planet_angles, strict=True):
        springs += _meshes(data, row, planet, psi)
        springs += _bearing(data, row, planet, psi)
    masses = []
    for body in (*central, *data.planets):
        values = getattr(data, body) if body in central else data.planet
        masses += [values.mass, values.mass, values.rim_mass]
    return SpringModel(coordinates, np.array(masses), tuple(springs))


def _meshes(data: PlanarSet, row: Rows, planet: str, psi: float) -> list[Spring]:
    a, b = data.sun_angle, data.ring_angle
    at_sun = {"sun.x": -math.sin(psi - a), "sun.y": math.cos(psi - a), "sun.u": 1.0}
    at_sun |= {f"{planet}.xi": -math.sin(a), f"{planet}.eta": -math.cos(a), f"{planet}.u": 1.0}
    at_ring = {"ring.x": -math.sin(psi + b), "ring.y": math.cos(psi + b), "ring.u": 1.0}
    at_ring |= {f"{planet}.xi": math.sin(b), f"{planet}.eta": -math.cos(b), f"{planet}.u": -1.0}
    return [
        Spring("sun_planet", data.sun_planet, row(at_sun)),
        Spring("planet_ring", data.planet_ring, row(at_ring)),
    ]


def _bearing(data: PlanarSet, row: Rows, planet: str, psi: float) -> list[Spring]:
    """Radial and tangential springs between the pin of the carrier and the planet."""
    along = {"carrier.x": math.cos(psi), "carrier.y": math.sin(psi), f"{planet}.xi": -1.0}
    across = {"carrier.x": -math.sin(psi), "carrier.y": math.cos(psi), "carrier.u": 1.0}
    across |= {f"{planet}.eta": -1.0}
    k = data.planet.bearing
    return [Spring("planet_bearing", k, row(along)), Spring("planet_bearing", k, row(across))]
