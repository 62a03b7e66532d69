"""The gearset: teeth, dimensions, inertia and planet positions."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import Field, model_validator

from ..gearset.clearance import Size, check_clearance
from ..gearset.kinematics import Teeth
from ..gearset.phasing import check_assembly
from .quantity import Section, quantity

Member = Literal["sun", "ring", "carrier"]
Held = Literal["sun", "ring", "carrier", "none"]


class ToothNumbers(Section):
    """Tooth numbers of the three kinds of gear."""

    sun: int = Field(ge=5, le=1000, description="teeth of the sun")
    planet: int = Field(ge=5, le=1000, description="teeth of a planet")
    ring: int = Field(ge=15, le=3000, description="teeth of the ring")


class EquivalentMasses(Section):
    """J/r^2 with the pitch radius; for the carrier with the radius of the planet centres."""

    sun: float = quantity("kg", "J/r^2 of the sun", gt=0.0, le=1e6)
    planet: float = quantity("kg", "J/r^2 of one planet", gt=0.0, le=1e6)
    ring: float = quantity("kg", "J/r^2 of the ring", gt=0.0, le=1e6)
    carrier: float = quantity("kg", "J/r^2 of the carrier without planets", gt=0.0, le=1e6)


class Gearset(Section):
    """Geometry and inertia of a simple planetary gearset of standard gears.

    Module and pressure angle are those of the transverse plane. Only the spatial natural modes use
    the helix angle; in simulations helical gears are spur gears of the transverse section.
    """

    teeth: ToothNumbers = Field(description="tooth numbers")
    module: float = quantity("m", "module, in the transverse plane", gt=0.0, le=1.0)
    pressure_angle: float = quantity(
        "rad", "pressure angle, in the transverse plane", ge=0.15, le=0.6
    )
    helix_angle: float = quantity(
        "rad",
        "helix angle on the pitch circle, positive for a right-hand sun",
        0.0,
        ge=-0.8,
        le=0.8,
    )
    addendum: float = quantity("", "addendum in modules", 1.0, gt=0.0, le=1.5)
    face_width: float = quantity("m", "face width", gt=0.0, le=5.0)
    planet_angles: tuple[float, ...] = quantity(
        "rad", "angular positions of the planets on the carrier", min_length=2, max_length=7
    )
    held: Held = Field("carrier", description="fixed member; none: a differential with two inputs")
    equivalent_mass: EquivalentMasses = Field(description="moments of inertia divided by r^2")
    planet_mass: float = quantity("kg", "mass of one planet", gt=0.0, le=1e6)

    @property
    def planets(self) -> int:
        """Number of planets."""
        return len(self.planet_angles)

    @property
    def tooth_numbers(self) -> Teeth:
        """Tooth numbers as a tuple."""
        return Teeth(self.teeth.sun, self.teeth.planet, self.teeth.ring)

    @model_validator(mode="after")
    def _can_be_put_together(self) -> Self:
        sun, planet, ring = self.tooth_numbers
        if ring != sun + 2 * planet:
            raise ValueError(
                f"teeth = {sun}/{planet}/{ring}: standard gears are coaxial only if "
                f"ring = sun + 2 planet = {sun + 2 * planet}"
            )
        size = Size(self.tooth_numbers, self.module, self.addendum)
        check_clearance(size, self.planet_angles)
        check_assembly(self.tooth_numbers, self.planet_angles, self.addendum)
        return self
