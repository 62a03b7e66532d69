"""Masses and bearings of the gearset, for natural modes in which axes move."""

from __future__ import annotations

from pydantic import Field

from .quantity import Section, quantity


class Support(Section):
    """One kind of body: its mass, its diametral inertia, and the springs that hold it."""

    mass: float = quantity("kg", "mass", gt=0.0, le=1e7)
    tilt_mass: float | None = quantity(
        "kg", "I/r^2 with the diametral inertia; not given: half of J/r^2", None, gt=0.0, le=1e7
    )
    bearing: float = quantity("N/m", "stiffness across the axis", ge=0.0, le=1e14)
    axial: float = quantity("N/m", "stiffness along the axis", 0.0, ge=0.0, le=1e14)
    tilting: float = quantity(
        "N/m", "stiffness against tilting: moment/angle/r^2", 0.0, ge=0.0, le=1e14
    )
    torsion: float = quantity(
        "N/m", "stiffness against turning: torque/angle/r^2", 0.0, ge=0.0, le=1e14
    )


class Supports(Section):
    """Sun, ring and carrier on the housing, planets on the carrier."""

    sun: Support = Field(description="on the housing")
    planet: Support = Field(description="every planet, on the carrier")
    ring: Support = Field(description="on the housing")
    carrier: Support = Field(description="on the housing")
