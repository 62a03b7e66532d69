"""Planar model of Lin and Parker 1999 (J. Vib. Acoust. 121, 316) with 3 (N + 3) coordinates.

Coordinates of sun, ring and carrier are x, y and u = r theta in the frame of the carrier. Those of
a planet are xi in the radial and eta in the tangential direction, and u. Gyroscopic terms, which
(36) of Salagianni et al. 2017 leaves out, are in `turning`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..model.planar_rows import CENTRAL, DRIVE, planar_rows
from .springs import Spring, SpringModel


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
    across: float | None = None
    """Radial stiffness across the radius of a planet [N/m]; None: `bearing`."""


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
    mesh_factors: tuple[float, ...] = ()
    """Factors on the stiffness of both meshes of each planet, 0 if open, (planets,); default: 1."""
    pin_factors: tuple[float, ...] = ()
    """Factors on the radial stiffness of each planet's bearing, (planets,); default: 1."""

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
    rows = planar_rows(data.planet_angles, data.sun_angle, data.ring_angle)
    identity = np.eye(len(rows.coordinates))
    springs = [
        Spring(
            f"{body}_{kind}",
            getattr(getattr(data, body), kind),
            identity[rows.place(f"{body}.{m}")],
        )
        for body in CENTRAL
        for kind, m in (("bearing", "x"), ("bearing", "y"), ("torsion", "u"))
    ]
    planets = len(data.planets)
    kinds = ["sun_planet"] * planets + ["planet_ring"] * planets
    factors = 2 * (data.mesh_factors or (1.0,) * planets)
    for kind, row, factor in zip(kinds, rows.flanks(DRIVE), factors, strict=True):
        springs.append(Spring(kind, factor * getattr(data, kind), row, factor))
    across = data.planet.bearing if data.planet.across is None else data.planet.across
    factors = data.pin_factors or (1.0,) * planets
    for (outwards, sideways), factor in zip(rows.pin, factors, strict=True):
        springs.append(Spring("planet_bearing", factor * data.planet.bearing, outwards, factor))
        springs.append(Spring("planet_bearing", factor * across, sideways, factor))
    masses = []
    for body in (*CENTRAL, *data.planets):
        values = getattr(data, body) if body in CENTRAL else data.planet
        masses += [values.mass, values.mass, values.rim_mass]
    return SpringModel(rows.coordinates, np.array(masses), tuple(springs))
