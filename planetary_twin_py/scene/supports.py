"""Masses and bearings of the gearset, for axes that move."""

from __future__ import annotations

import math

from pydantic import Field

from .quantity import Section, quantity


class Support(Section):
    """Mass, diametral inertia and bearing stiffness of one kind of body.

    r is the base radius of a gear, and the radius of the planet centres of the carrier. A member
    that floats has a stiffness of 0. The default damping is the middle of the range of Friswell,
    Penny, Garvey and Lees 2010.
    """

    mass: float = quantity("kg", "mass", gt=0.0, le=1e7)
    tilt_mass: float | None = quantity(
        "kg", "diametral inertia I/r^2; default: half of J/r^2", None, gt=0.0, le=1e7
    )
    bearing: float = quantity("N/m", "radial bearing stiffness", ge=0.0, le=1e14)
    damping: float | None = quantity(
        "N s/m", "radial damping of the bearing; default: 1.25e-5 s times its stiffness", None,
        ge=0.0, le=1e10,
    )  # fmt: skip
    clearance: float = quantity("m", "radial clearance of the bearing", 0.0, ge=0.0, le=1e-2)
    axial: float | None = quantity(
        "N/m", "axial bearing stiffness, for dynamics: spatial and spatial natural modes", None,
        ge=0.0, le=1e14,
    )  # fmt: skip
    tilting: float | None = quantity(
        "N/m", "tilting stiffness: moment/angle/r^2, for the same", None, ge=0.0, le=1e14
    )
    axial_damping: float | None = quantity(
        "N s/m", "axial damping; default: 1.25e-5 s times the stiffness", None, ge=0.0, le=1e10
    )
    tilting_damping: float | None = quantity(
        "N s/m", "tilting damping: moment/angular speed/r^2; default: 1.25e-5 s times the "
        "stiffness", None, ge=0.0, le=1e10,
    )  # fmt: skip
    torsion: float = quantity("N/m", "torsional stiffness: torque/angle/r^2", 0.0, ge=0.0, le=1e14)

    def diametral(self, rim_mass: float) -> float:
        """Diametral inertia.

        Args:
            rim_mass: polar inertia J/r^2 of the body [kg].

        Returns:
            I/r^2 [kg], given or that of a flat disc.
        """
        return 0.5 * rim_mass if self.tilt_mass is None else self.tilt_mass


class Supports(Section):
    """Supports of sun, ring and carrier in the housing, and of the planets on the carrier."""

    sun: Support = Field(description="support of the sun in the housing")
    planet: Support = Field(description="support of every planet on the carrier")
    ring: Support = Field(description="support of the ring in the housing")
    carrier: Support = Field(description="support of the carrier in the housing")
    gravity: float = quantity(
        "m/s^2", "acceleration of gravity in the plane of the gears; 0: weight is left out", 0.0,
        ge=0.0, le=100.0,
    )  # fmt: skip
    gravity_direction: float = quantity(
        "rad", "direction of gravity, counter-clockwise from x of the housing", -0.5 * math.pi,
        ge=-6.3, le=6.3,
    )  # fmt: skip
