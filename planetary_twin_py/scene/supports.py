"""Masses and bearings of the gearset, for axes that move."""

from __future__ import annotations

import math
from typing import Self

from pydantic import Field, model_validator

from .quantity import Section, quantity


class Rolling(Section):
    """Rollers or balls of a bearing, whose force is that of Palmgren 1959.

    The force is a mean over the positions of the cage, so it excites no vibration of its own.
    """

    rollers: int | None = Field(None, description="number of rollers", ge=3, le=1000)
    length: float | None = quantity("m", "length over which a roller carries", None, gt=0.0, le=1.0)
    balls: int | None = Field(None, description="number of balls", ge=3, le=1000)
    diameter: float | None = quantity("m", "diameter of a ball", None, gt=0.0, le=1.0)
    damping_time: float = quantity(
        "s", "damping over stiffness, in every direction", 1.25e-5, ge=0.0, le=1e-3
    )

    @property
    def elements(self) -> int:
        """Number of rollers or balls."""
        return self.rollers or self.balls or 0

    @property
    def text(self) -> str:
        """Number and size of the elements, e.g. "14 rollers of 12 mm"."""
        kind, size = ("rollers", self.length) if self.rollers else ("balls", self.diameter)
        return f"{self.elements} {kind} of {1e3 * (size or 0.0):g} mm"

    @model_validator(mode="after")
    def _rollers_or_balls(self) -> Self:
        rollers = self.rollers is not None and self.length is not None
        balls = self.balls is not None and self.diameter is not None
        given = sum(v is not None for v in (self.rollers, self.length, self.balls, self.diameter))
        if given != 2 or not (rollers or balls):
            raise ValueError("must have either rollers and length, or balls and diameter")
        return self


class Support(Section):
    """Mass, diametral inertia and bearing of one kind of body.

    r is the base radius of a gear, and the radius of the planet centres of the carrier. A member
    that floats has a stiffness of 0. The default damping is the middle of the range of Friswell,
    Penny, Garvey and Lees 2010.
    """

    mass: float = quantity("kg", "mass", gt=0.0, le=1e7)
    tilt_mass: float | None = quantity(
        "kg", "diametral inertia I/r^2; default: half of J/r^2", None, gt=0.0, le=1e7
    )
    bearing: float | None = quantity(
        "N/m", "radial bearing stiffness; required without `rolling`", None, ge=0.0, le=1e14
    )
    rolling: Rolling | None = Field(
        None, description="rollers or balls of the bearing, in place of `bearing` and `damping`"
    )
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

    @model_validator(mode="after")
    def _one_radial_law(self) -> Self:
        if self.bearing is None and self.rolling is None:
            raise ValueError("bearing: required (0 N/m: the body floats), or rolling")
        if self.rolling is not None:
            for name in ("bearing", "damping"):
                if getattr(self, name) is not None:
                    raise ValueError(f"{name}: must be null, as rolling has its own law")
        return self

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
