"""What drives the gearset and what it drives."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from .gearset import Member
from .quantity import Section, quantity


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
