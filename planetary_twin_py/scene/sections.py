"""The parts of a scene: what the gears are, how they touch, what drives them."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import Field, model_validator

from ..gearset.kinematics import Teeth
from ..gearset.phasing import check_assembly
from .quantity import Section, quantity

Member = Literal["sun", "ring", "carrier"]


class ToothNumbers(Section):
    """Tooth numbers of the three kinds of gear."""

    sun: int = Field(ge=5, le=1000)
    planet: int = Field(ge=5, le=1000)
    ring: int = Field(ge=15, le=3000)


class EquivalentMasses(Section):
    """J/r^2 with the pitch radius; with the radius of the planet centres for the carrier."""

    sun: float = quantity("kg", "J/r^2 of the sun", gt=0.0, le=1e6)
    planet: float = quantity("kg", "J/r^2 of one planet", gt=0.0, le=1e6)
    ring: float = quantity("kg", "J/r^2 of the ring", gt=0.0, le=1e6)
    carrier: float = quantity("kg", "J/r^2 of the carrier without planets", gt=0.0, le=1e6)


class Gearset(Section):
    """Geometry and inertia of a simple planetary gearset of standard spur gears."""

    teeth: ToothNumbers
    module: float = quantity("m", "module", gt=0.0, le=1.0)
    pressure_angle: float = quantity("rad", "pressure angle", ge=0.15, le=0.6)
    addendum: float = quantity("", "addendum in modules", 1.0, gt=0.0, le=1.5)
    face_width: float = quantity("m", "face width", gt=0.0, le=5.0)
    planet_angles: tuple[float, ...] = quantity(
        "rad", "positions of the planets on the carrier", min_length=2, max_length=7
    )
    held: Member = "carrier"
    equivalent_mass: EquivalentMasses
    planet_mass: float = quantity("kg", "mass of one planet", gt=0.0, le=1e6)

    @property
    def planets(self) -> int:
        """Number of planets."""
        return len(self.planet_angles)

    @property
    def tooth_numbers(self) -> Teeth:
        """Tooth numbers as the kinematics takes them."""
        return Teeth(self.teeth.sun, self.teeth.planet, self.teeth.ring)

    @model_validator(mode="after")
    def _can_be_put_together(self) -> Self:
        sun, planet, ring = self.tooth_numbers
        if ring != sun + 2 * planet:
            raise ValueError(
                f"teeth = {sun}/{planet}/{ring}: standard gears share their axes only if "
                f"ring = sun + 2 planet = {sun + 2 * planet}"
            )
        check_assembly(self.tooth_numbers, self.planet_angles)
        return self


class MeshDamping(Section):
    """Damping c = tau k of a mesh in every state of contact.

    "meshing_frequency": tau = loss_factor/f_m, f_m not below `lowest_frequency` (Salagianni et
    al. 2017, section 3, whose printed law is unbounded at standstill). "viscous": tau constant,
    from the damping ratio of the mesh on its own two gears at single-pair stiffness.
    """

    law: Literal["meshing_frequency", "viscous"] = "viscous"
    damping_ratio: float = quantity("", "damping ratio of one mesh", 0.05, ge=0.0, le=2.0)
    loss_factor: float = quantity("", "tau times meshing frequency", 0.009, ge=0.0, le=1.0)
    lowest_frequency: float = quantity(
        "Hz", "meshing frequency below which the law no longer follows it", 5.0, gt=0.0, le=1e4
    )


class Mesh(Section):
    """Stiffness and damping along the line of action."""

    sun_planet_stiffness: float = quantity("N/m", "of a single tooth pair", ge=1e3, le=1e13)
    planet_ring_stiffness: float = quantity("N/m", "of a single tooth pair", ge=1e3, le=1e13)
    double_pair_ratio: float = quantity(
        "", "stiffness of two pairs over that of one", 1.75, ge=1.0, le=2.0
    )
    ramp: float = quantity(
        "", "base pitches over which a pair takes up its load; 0: at once", 0.03, ge=0.0, le=0.2
    )
    damping: MeshDamping = MeshDamping()


class Lubrication(Section):
    """Oil, surfaces, and the choice of laws for film, lambda ratio and traction."""

    friction: bool = Field(True, description="tooth friction on or off")
    film: Literal["dowson_higginson", "dowson_toyoda", "salagianni"] = "dowson_higginson"
    lambda_ratio: Literal["prescribed", "computed"] = "computed"
    viscosity: float = quantity("Pa s", "at atmospheric pressure", gt=0.0, le=10.0)
    pressure_viscosity: float = quantity("1/Pa", "pressure coefficient", gt=0.0, le=1e-6)
    temperature_viscosity: float = quantity("1/K", "thermal coefficient", 0.04, gt=0.0, le=1.0)
    shear_stress: float = quantity("Pa", "Eyring stress", gt=0.0, le=1e9)
    oil_conductivity: float = quantity("W/(m K)", "of the oil", 0.137, gt=0.0, le=1e4)
    solid_conductivity: float = quantity("W/(m K)", "of the gears", 46.0, gt=0.0, le=1e4)
    solid_density: float = quantity("kg/m^3", "of the gears", 7800.0, gt=0.0, le=1e5)
    solid_heat_capacity: float = quantity("J/(kg K)", "of the gears", 470.0, gt=0.0, le=1e5)
    youngs_modulus: float = quantity("Pa", "of the gears", 206e9, gt=0.0, le=1e12)
    poisson_ratio: float = quantity("", "of the gears", 0.3, ge=0.0, lt=0.5)
    roughness_parameter: float = quantity("", "xi beta sigma", 0.055, gt=0.0, le=1.0)
    asperity_slope: float = quantity("", "sigma/beta", 0.001, gt=0.0, le=1.0)
    pressure_coefficient: float = quantity("", "eps of the boundary film", 0.17, ge=0.0, le=1.0)
    composite_roughness: float = quantity("m", "sigma of both flanks", 2e-7, gt=0.0, le=1e-4)
    sliding_threshold: float = quantity(
        "",
        "slide-to-roll ratio at which traction reaches tanh(1) of its plateau",
        0.015,
        gt=0.0,
        le=1.0,
    )


class Machine(Section):
    """Motor or load, coupled elastically to a member of the gearset."""

    member: Member
    inertia: float = quantity("kg m^2", "moment of inertia", gt=0.0, le=1e9)
    coupling_stiffness: float = quantity("N m/rad", "of the shaft coupling", gt=0.0, le=1e12)
    coupling_damping: float = quantity("N m s/rad", "of the shaft coupling", ge=0.0, le=1e9)


class SpeedControl(Section):
    """How the drive reaches and keeps the speed, and how its torque fluctuates."""

    bandwidth: float = quantity("Hz", "of the speed loop", 3.0, gt=0.0, le=100.0)
    slew_rate: float = quantity("rad/s^2", "of the speed set-point", 500.0, gt=0.0, le=1e6)
    ripple_order: int = Field(2, ge=1, le=100, description="torque cycles per turn of the motor")


class Drive(Section):
    """Power flow: motor at the input, load at the output."""

    input: Machine
    output: Machine
    speed_control: SpeedControl = SpeedControl()

    @model_validator(mode="after")
    def _two_members(self) -> Self:
        if self.input.member == self.output.member:
            raise ValueError(f"output.member = {self.output.member!r}: is the input already")
        return self
